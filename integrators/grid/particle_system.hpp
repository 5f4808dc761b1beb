#pragma once
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "integrators/grid/error_scales.hpp"
#include "integrators/grid/grid_integrator.hpp"
#include "integrators/sundials/ark_system.hpp"
#include "mpm/reactions.hpp"
#include "mpm/tractions.hpp"
#include "mpm/transfer.hpp"
#include "mpm/trial.hpp"

namespace vitrum {

/// The particles as a system of ordinary differential equations. Unknowns of each body, one array after
/// another: displacement since `begin` (2), velocity (2), strain (4; plane strain: 3) in the frame that turns
/// with the particle, turn (1); at the end the external work, where there can be any, and for each pair of
/// bodies with contact its impulse (2). The grid is scratch:
///   x' = sum N v_i,  v' = sum N f_i / m_i,  e' = R^T D R,  w' = spin,  with R the rotation by w,
/// and the stress is the material's response to (committed state, strain since the last commit, time since
/// then); so is the friction of contact, to how surfaces have moved since. Errors are relative to the cell,
/// the scene's velocity scale, and its strain scale plus the particle's strain in the last step: where a step
/// strains by much more than the elastic limit something flows or opens, and the stress depends on the
/// direction of the strain rather than on its size.
class ParticleSystem final : public sundials::ArkSystem {
 public:
  /// system must outlive it. tolerance: relative to the scales. oscillation_limit: largest phase of an
  /// undamped oscillation in one step (frequency x step) that the method stands.
  ParticleSystem(System& system, const ErrorScales& scales, double tolerance, double oscillation_limit);

  std::size_t size() const override { return size_; }
  /// The impulses of boundaries since `begin`.
  std::size_t integrals() const override { return reactions_.size(); }
  bool rates(double t, const double* y, double* rates) override;
  void error_weights(double* weights) const override;
  double stable_step(double t, const double* y) override;
  /// Whether contact, stiffer than the grid, was what `stable_step` found last.
  bool contact_limits() const { return contact_limits_; }
  std::size_t parts() const override { return parts_.size(); }
  void for_ranges(RangeTask task, void* context) const override;

  /// Starts from the system's particles and time.
  /// load_change: s, no load's rate jumps before.
  void begin(double* y, double load_change = std::numeric_limits<double>::infinity());
  /// Makes y at time t the system's state: particles, stress, internal variables, record of the step. True: a
  /// particle has crossed the axis and was replaced by its image, is carried by held nodes from now on, or
  /// has left; the solver must start anew, from `begin`.
  bool commit(double t, double* y);

  /// Adds the estimated local errors of a step.
  void add_errors(const double* errors, ErrorEstimate& estimate) const;
  /// Names an unknown: body, particle, place, quantity.
  std::string describe(std::size_t unknown) const;
  /// The unknown whose rate was not finite when `rates` was last evaluated.
  std::optional<std::size_t> not_finite() const { return not_finite_; }
  /// The error of an unknown that counts as one.
  double tolerance_of(std::size_t unknown) const;

 private:
  enum class Quantity { displacement, velocity, strain };
  /// Particles [begin, end) of a body: what one thread takes at a time.
  struct Part {
    std::size_t body, begin, end;
  };
  static constexpr std::size_t most_in_part = 256;  ///< few: what is read twice stays in the innermost cache
  static constexpr std::size_t displacement = 0, velocity = 2, strain = 4;
  std::size_t turn() const { return system_.axisymmetric ? 8 : 7; }
  std::size_t arrays() const { return turn() + 1; }
  /// Place in y of an array of a body; strain components are rr, zz, (tt,) rz.
  std::size_t place(std::size_t body, std::size_t array) const {
    return first_[body] + array * system_.bodies[body].particles.size;
  }
  TensorPointers<const double> strain_arrays(std::size_t body, const double* y) const;
  static Quantity quantity_of(std::size_t array);
  double tolerance_of(Quantity quantity, std::size_t body, std::size_t particle) const;
  /// Calls f(part, its index) on all threads.
  template <class F>
  void for_each_part(F&& f) const {
    system_.team->for_each_chunk(parts_.size(), [&](std::size_t k) { f(parts_[k], k); });
  }
  void order_parts();
  bool is_finite(const double* values) const;
  void set_loads(double t);
  double carrying_slack() const;
  void load(const double* y);
  bool set_increments(const double* y);
  void try_stress(double t, bool changed);
  std::vector<mpm::Configuration> places(const double* y);
  static std::vector<mpm::ParticleMotion> motions(std::span<const mpm::ParticleRates> rates);
  void rest_removed(double* rates) const;
  void mirror_rates(const double* y, double* rates) const;
  double kinetic_energy();
  bool reflect(double* y);
  bool filter_velocities();
  bool carry();

  System& system_;
  ErrorScales scales_;
  std::optional<std::size_t> not_finite_;
  double tolerance_, oscillation_limit_;
  bool works_;                       ///< external work is an unknown
  std::size_t size_ = 0, tail_ = 0;  ///< tail_: the first unknown that is no particle's
  std::vector<std::size_t> first_;   ///< by body
  std::vector<Part> parts_;
  std::vector<double> of_parts_;  ///< a result of each, for what ARKODE calls must not allocate
  mpm::Trial trial_;
  mpm::ReactionIntegrals reactions_;
  struct Start {
    VectorColumns position;  ///< at `begin`
    TensorColumns strain;    ///< at the last commit
    std::vector<double> turn;
    std::vector<double> no_strain;  ///< takes the hoop rate of plane strain
  };
  std::vector<Start> start_;                        ///< by body
  std::vector<std::vector<std::size_t>> mirrored_;  ///< by body: particles of the trial beyond the axis
  std::vector<std::vector<double>>
      last_strain_;  ///< by body: norm of each particle's strain in the last step
  /// By body, where bodies have contact or tractions: turn since the start, and side, of the state tried.
  std::vector<std::array<std::vector<double>, 2>> turned_;
  std::vector<double> committed_tail_, changes_;
  double committed_time_ = 0.0;
  bool contact_limits_ = false;
  double load_change_ = 0.0;   ///< s, the next that is known
  double carried_work_ = 0.0;  ///< done at `begin`, not booked yet
};

}  // namespace vitrum
