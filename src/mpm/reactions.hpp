#pragma once
#include <cstddef>
#include <vector>

#include "mpm/system.hpp"

namespace vitrum::mpm {

/// Two components for each boundary.
std::size_t reaction_count(const System& system);

/// Adds the force of each boundary on the bodies, N (per radian or per metre), to `forces`, at the nodal
/// masses and forces of the present. At a node that it holds a boundary gives what makes the node move as it
/// does, m a - f - m g. A plane of symmetry also gives what its images lack: a particle's share of an image
/// comes back from the node with the sign changed, so that of the force f' and the mass m' that an image has
/// collected, with the node's acceleration a, -2 (f' + m' a) across the plane reaches no particle. The sum
/// over boundaries and gravity is the rate of the particles' momentum, but for radial components (hoop
/// stress, the axis).
void add_reactions(const System& system, double* forces);

/// Adds their impulses over a step of `duration` seconds to system.record.
void book_reactions(System& system, double duration);

/// The impulses as integrals that an ODE solver forms behind its unknowns.
class ReactionIntegrals {
 public:
  explicit ReactionIntegrals(const System& system) : committed_(reaction_count(system)) {}

  std::size_t size() const { return committed_.size(); }
  void begin(double* integrals);
  /// At the nodal masses and forces of the present.
  void rates(const System& system, double* rates) const;
  /// Enters into system.record what came to them since the last time, or `begin`.
  void commit(System& system, const double* integrals);

 private:
  std::vector<double> committed_;
};

}  // namespace vitrum::mpm
