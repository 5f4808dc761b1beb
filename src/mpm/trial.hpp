#pragma once
#include <array>
#include <vector>

#include "mpm/system.hpp"

namespace vitrum::mpm {

/// Columns of one body that a trial replaces. Empty columns of the state are not replaced.
struct TrialColumns {
  VectorColumns position, velocity;
  TensorColumns elastic_strain;
  TensorColumns stress;           ///< Particles::tried_stress
  std::vector<double> stress_zr;  ///< nominal stress only
};

/// A state that an integrator tries out without touching the committed one: of every body the columns that a
/// right-hand side needs.
class Trial {
 public:
  enum class Moves {
    particles,  ///< positions and velocities are tried too
    nodes,      ///< particles stay; elastic strain and nominal stress are tried
  };
  Trial(const System& system, Moves moves);

  TrialColumns& of(std::size_t body) { return columns_[body]; }
  const TrialColumns& of(std::size_t body) const { return columns_[body]; }

  /// While it exists, the particles of the system are in the state tried, and the committed state lies in the
  /// Trial. No column is copied, and an exception restores the committed state.
  class Scope {
   public:
    Scope(System& system, Trial& trial) : system_(system), trial_(trial) { trial_.exchange(system_); }
    ~Scope() { trial_.exchange(system_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    System& system_;
    Trial& trial_;
  };

 private:
  void exchange(System& system);
  std::vector<TrialColumns> columns_;
};

}  // namespace vitrum::mpm
