#pragma once
#include <optional>
#include <string>
#include <vector>

#include "integrators/grid/error_scales.hpp"
#include "integrators/grid/grid_integrator.hpp"
#include "integrators/sundials/ark_system.hpp"
#include "mpm/consistent_mass.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/finite_strain.hpp"
#include "mpm/loads.hpp"
#include "mpm/nodal_unknowns.hpp"
#include "mpm/reactions.hpp"
#include "mpm/stiffness.hpp"
#include "mpm/tractions.hpp"
#include "mpm/transfer.hpp"
#include "mpm/trial.hpp"

namespace vitrum {

/// The grid over one Lagrangian phase, in which particles keep their places and shape functions. Unknowns:
/// displacements u_i of the free components of filled nodes since the phase began, their velocities v_i, the
/// external work where there can be any, and for each pair of bodies with contact its impulse (2):
///   u' = v,  v'_i = sum_j M_ij / m_i f_j(u) / m_j,
/// M the consistent mass: nodes accelerate their particles by sum N f/m, and move as what these project to,
/// so that a phase knows no motion that particles do not carry on (docs/theory/adaptive.md). The changes
/// q' = f/m that the particles get when the phase ends are integrals. With the stress of each particle the
/// material's response to (committed state, strain since the last commit, time since then), the strain being
/// U - 1 of the phase's deformation gradient F = R U. Forces are the derivative of the energy as a function
/// of that strain, so that an elastic phase conserves energy for any rotation
/// (docs/theory/strain-and-stress.md).
class GridSystem final : public sundials::ReducibleSystem {
 public:
  /// system must outlive it. tolerance: relative to the scales. travel: cells that a node goes in a phase.
  GridSystem(System& system, const ErrorScales& scales, double tolerance, double travel = 0.25);

  /// Starts a phase from the system's particles. y is filled by `start`.
  void begin_phase();
  void start(double* y);

  std::size_t size() const override { return 2 * nodes_.size() + tail_; }
  /// What nodes have changed the velocities of their particles by, and the impulses of boundaries, since the
  /// phase began.
  std::size_t integrals() const override { return nodes_.size() + reactions_.size(); }
  bool rates(double t, const double* y, double* rates) override;
  void error_weights(double* weights) const override;

  const sundials::SparsePattern& pattern() const override { return pattern_; }
  bool linearise(double t, const double* y) override;
  void form(double gamma, double* values) const override;
  void reduce(double gamma, const double* b, double* c) const override;
  void expand(double gamma, const double* b, const double* z, double* x) const override;

  /// Where nothing is free to move, held nodes carry all particles along: fills y, which holds at most the
  /// external work and the impulses of boundaries from `from` to `to` (Simpson's rule).
  void carry(double from, double to, std::vector<double>& y);
  /// Makes the stress and the internal variables of y at time t the system's; fills the record of the step.
  /// Particles keep their places; the record's kinetic energy is the grid's change added to the particles' at
  /// the start of the phase.
  void commit(double t, const double* y);
  /// Moves the particles: v += N q_i, x += N u_i. Returns the kinetic energy that is lost thereby (never
  /// gained), J (per radian or per metre).
  double end_phase(const double* y);

  /// Longest way of a node that matters (cells), largest strain or turn of a particle, since the phase began.
  double travel(const double* y) const;
  /// Of the nodes near those that boundaries hold, from where a boundary that moves has come to (cells).
  double travel_at_walls(const double* y) const;
  double deformation() const { return deformation_; }

  /// Adds the estimated local errors of a step.
  void add_errors(const double* errors, ErrorEstimate& estimate) const;
  std::string describe(std::size_t unknown) const;
  /// The unknown whose rate was not finite when `rates` was last evaluated.
  std::optional<std::size_t> not_finite() const { return not_finite_; }
  /// The error of an unknown that counts as one.
  double tolerance_of(std::size_t unknown) const;

 private:
  void stretch_domains();
  void rest_removed(std::size_t body);
  struct Deformation {
    std::array<std::vector<double>, 5> gradient;  ///< (rr, rz, zr, zz, tt)
    mpm::FiniteStrain at(std::size_t i) const {
      return mpm::FiniteStrain(
          {gradient[0][i], gradient[1][i], gradient[2][i], gradient[3][i], gradient[4][i]});
    }
    TensorColumns committed_strain;
    std::vector<double> committed_turn;
  };
  /// Where the particles are while a phase goes on, and how they move; only where bodies have contact or
  /// tractions.
  struct Motion {
    std::array<std::vector<double>, 2> displacement, position;
    std::vector<double> turn;
    // Only where there are tractions:
    std::array<std::vector<double>, 2> velocity;
    std::array<std::vector<double>, 5> velocity_gradient;
    std::vector<double> spin;
  };
  void set_loads(double t);
  double book_driven(double t, const double* q);
  const double* changes_of_particles(const double* y) const { return y + size(); }
  bool deform(double t, const double* y);
  std::vector<mpm::Configuration> places();
  bool touch();
  std::vector<mpm::ParticleMotion> motions(const double* y);
  void set_increments(bool as_committed);
  void try_stress(double t, bool changed);
  double weight_of_mass(std::size_t unknown) const;

  System& system_;
  ErrorScales scales_;
  std::optional<std::size_t> not_finite_;
  double tolerance_;
  bool works_;
  std::size_t tail_;  ///< unknowns behind those of the nodes
  double travel_;     ///< cells
  mpm::Trial trial_;
  mpm::ReactionIntegrals reactions_;
  mpm::NodalUnknowns nodes_;
  mpm::ConsistentMass mass_;
  mpm::Stiffness stiffness_;
  std::vector<double> stiffness_values_;
  sundials::SparsePattern pattern_;       ///< of M diag(1/m) K
  std::vector<double> mobile_stiffness_;  ///< its values
  std::vector<std::size_t> diagonal_;     ///< places in it
  std::vector<std::vector<TangentEntries>> tangents_;
  std::vector<Deformation> deformations_;         ///< by body
  std::vector<mpm::ParticleGradient> gradients_;  ///< pointers into them
  std::vector<Motion> motions_;                   ///< by body
  std::vector<double> committed_tail_, changes_;
  std::vector<double> start_velocity_;  ///< by node unknown
  /// Velocities of boundaries when the phase began, and at the last commit.
  mpm::OfBoundaries held_at_start_, held_committed_;
  double start_time_ = 0.0, committed_time_ = 0.0;
  double carried_work_ = 0.0;  ///< done when the phase began, not booked yet
  double driven_gain_ = 0.0;   ///< kinetic energy by varying velocities of boundaries, committed
  double start_kinetic_ = 0.0, mean_mass_ = 0.0, deformation_ = 0.0;
};

}  // namespace vitrum
