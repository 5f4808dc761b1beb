#pragma once
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "materials/composite/state.hpp"
#include "materials/composite/tolerances.hpp"
#include "materials/event_driven.hpp"

namespace vitrum {

/// Which of the laws act. Frozen between events.
struct CompositeMode {
  enum class Plane {
    intact,      ///< not localised
    held,        ///< localised, traction below the strength: elastic with the opening frozen
    decohering,  ///< the plane softens, eqs. 13-18
    open,        ///< separated, faces free of traction
    closed       ///< separated, faces in contact, or rubble under pressure
  };

  bool tension = false;   ///< side of zero mean elastic strain
  bool damaging = false;  ///< crack density follows eq. 7
  bool flowing = false;   ///< on the yield surface
  bool pulled = false;    ///< decohering under tensile normal traction (otherwise by shear alone)
  bool viscous = false;   ///< decohering with a viscosity
  bool sliding =
      false;  ///< held at zero mean strain, which either side leads back to: keeps the side it came from
  double slides = 0.0;   ///< +1, -1: closed faces slide so under friction; 0: they stick, or nothing rubs
  double sheared = 1.0;  ///< rubble from its closure on: share of a deviator that stays elastic
  Plane plane = Plane::intact;
  double coefficient = 0.0;                                     ///< C(R) of eq. 7
  double hardening_modulus = 0.0;                               ///< h of eq. 21 on the present branch, Pa
  double branch_end = std::numeric_limits<double>::infinity();  ///< plastic strain at which it ends

  bool decohering() const { return plane == Plane::decohering; }
  bool separated() const { return plane == Plane::open || plane == Plane::closed; }
  /// Whether anything but the elastic strain changes along a curve; otherwise the state moves along a
  /// straight line.
  bool evolves() const { return damaging || flowing || decohering() || rubs(); }
  bool rubs() const { return slides != 0.0; }
  /// Whether the strain may have to go back for the state to stay in equilibrium: a plane that softens
  /// without viscosity, or softening flow behind faces that give way.
  bool may_snap_back() const {
    return (decohering() && !viscous) || (flowing && separated() && hardening_modulus < 0.0);
  }
};

/// d(state)/d(parameter). The parameter is the fraction of the path, except in a mode that may snap back:
/// there `fraction` falls to zero as the state approaches that, where the rates with respect to the fraction
/// would be infinite.
struct CompositeRates {
  /// Where it is less than this, the state can no longer follow the path: what would take a millionth of the
  /// increment is a jump.
  static constexpr double least_fraction = tolerance::jump;

  double fraction = 1.0;
  SymmetricTensor elastic_strain{};
  double crack_density = 0.0, plastic_strain = 0.0, decohesion = 0.0, opening_n = 0.0, opening_t = 0.0;
  double plastic = 0.0, damage = 0.0, fracture = 0.0;  ///< dissipation, J/m^3

  bool advances() const { return fraction > least_fraction; }
};

/// How the rates of a decohering plane (without flow) depend on what the plane has done: rows lambda, normal
/// and tangential opening (m), fracture energy (J/m^3); columns lambda, normal and tangential opening.
using OpeningJacobian = std::array<std::array<double, 3>, 4>;

/// What may end a mode.
enum class CompositeGuard : unsigned char {
  mean_strain_sign,      ///< the mean elastic strain changes sign
  damage,                ///< eq. 7 reaches the crack density held so far
  exhausted,             ///< the crack density reaches its limit
  yield,                 ///< the yield surface is reached
  unload,                ///< the plastic multiplier vanishes
  strength_branch,       ///< hardening or softening ends
  localisation,          ///< Phi = 0, or H = H_cr
  decohesion,            ///< the traction reaches the strength of the plane
  opening_stops,         ///< the rate of decohesion vanishes
  snap_back,             ///< no equilibrium is left beyond
  normal_traction_sign,  ///< the normal traction of a softening plane changes sign
  separation,            ///< lambda = 1
  closure,               ///< the gap vanishes
  opening,               ///< the contact traction vanishes
  slip,                  ///< shear reaches what friction bears
  stick,                 ///< sliding faces come to rest
};

/// The composite as an ODE between events, whatever its models.
class CompositeModes : public EventDriven {
 public:
  Course& enter(CourseRoom& room, const PointState& point, const StrainPath& path,
                PointReport& report) const final;
  virtual CompositeState load(const PointState& point) const = 0;
  virtual void store(const CompositeState& state, PointState& point) const = 0;
  /// The mode at the start of a path. Performs the jumps that the state asks for (snap-back, excess shear)
  /// and books them.
  virtual CompositeMode first_mode(CompositeState& state, const StrainPath& path,
                                   PointReport& report) const = 0;
  /// The mode after `root` ended `mode` at `fraction` of the path; performs the jumps and records the event.
  virtual void transition(CompositeMode& mode, CompositeGuard root, CompositeState& state,
                          const StrainPath& path, double fraction, PointReport& report) const = 0;
  virtual CompositeRates rates(const CompositeMode& mode, const CompositeState& state,
                               const StrainPath& path) const = 0;
  /// d(rates)/d(state) of a plane that decoheres with a viscosity, without plastic flow.
  virtual OpeningJacobian opening_jacobian(const CompositeMode& mode, const CompositeState& state,
                                           const StrainPath& path) const = 0;
  /// Guards of the mode (by CompositeGuard).
  virtual void guards(const CompositeMode& mode, const CompositeState& state, const StrainPath& path,
                      Guards& values) const = 0;
  /// Drift correction: puts a state that was integrated with errors back onto the yield surface, the strength
  /// of the plane, and traction-free faces.
  virtual void project(const CompositeMode& mode, CompositeState& state, const StrainPath& path) const = 0;
  /// Moduli that give the stress of a state (damaged bulk modulus only under tension), and those of the
  /// virgin material.
  virtual Moduli secant_moduli(const CompositeState& state) const = 0;
  virtual Moduli virgin_moduli() const = 0;
  /// Opening of the plane of a state in pure mode I at lambda = 1, m.
  virtual double reference_opening(const CompositeState& state) const = 0;
};

}  // namespace vitrum
