#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "materials/elasticity.hpp"
#include "schema/fields.hpp"
#include "tensor/vector.hpp"

namespace vitrum {

/// What bears a point whose plane has separated.
enum class Separated : unsigned char {
  faces,           ///< two faces: free of traction while open, elastic under pressure once closed
  pressure,        ///< rubble: pressure, once the void is closed, and nothing else
  drucker_prager,  ///< rubble: that, and shear up to q = beta P
  nothing,
  removed  ///< nothing, and its mass is gone as well
};

/// Scene table [material.NAME.decohesion]: from localisation to separation, eqs. 10-18.
struct DecohesionParameters {
  double opening = 0.0;            ///< u0, m
  double q = 1.0;                  ///< exponent of eq. 13
  double mode_ratio = 1.0;         ///< C_m = tau_tp / tau_np
  double viscosity = 0.0;          ///< eta, s; > 0: eta lambda' = <f>/U0
  bool search_all_planes = false;  ///< plane = "all": a hoop normal may win
  // Readings of what the paper leaves open.
  std::optional<double> tau_bar_0 = {};  ///< Pa, of U0 = u0 tau_bar_0; absent: tau_np of the onset
  bool undamaged = false;                ///< E of eq. 10 is that of the virgin material
  bool pressure_counts = false;          ///< eqs. 15-18 as printed: normal pressure drives the plane, too
  bool partial_compression = true;       ///< localises although a principal stress is compressive
  bool flow_behind_plane = true;         ///< a localised point may still flow
  Separated separated = Separated::faces;
  double friction = 0.0;  ///< Coulomb's coefficient between the faces of a separated plane

  static schema::Fields<DecohesionParameters> rows();
};

/// A plane through a material point: unit normal n and tangent t = n turned by +90 degrees; both components
/// 0: the hoop plane, which carries no shear in these geometries.
struct DecohesionPlane {
  double r, z;

  constexpr DecohesionPlane(double normal_r, double normal_z) : r(normal_r), z(normal_z) {}
  constexpr explicit DecohesionPlane(const PlaneVector& normal) : r(normal.r), z(normal.z) {}

  constexpr bool hoop() const { return r == 0.0 && z == 0.0; }
  constexpr double normal_part(const SymmetricTensor& a) const {
    return hoop() ? a.tt : r * r * a.rr + z * z * a.zz + 2.0 * r * z * a.rz;
  }
  constexpr double tangential_part(const SymmetricTensor& a) const {
    return hoop() ? 0.0 : r * z * (a.zz - a.rr) + (r * r - z * z) * a.rz;
  }
  /// Strain of a jump (normal, tangential) smeared over `length`, eq. 12.
  constexpr SymmetricTensor jump_strain(double normal, double tangential, double length) const {
    if (hoop()) return {0.0, 0.0, normal / length, 0.0};
    const double n = normal / length, t = tangential / length;
    return {n * r * r - t * r * z, n * z * z + t * r * z, 0.0, n * r * z + 0.5 * t * (r * r - z * z)};
  }
  /// L_e: volume over plane area of a square cell of side `cell` (m), eq. 12; the cell's side for a hoop
  /// plane.
  double effective_length(double cell) const {
    return hoop() ? cell : cell * std::max(std::abs(r), std::abs(z));
  }
};

/// Traction on the decohesion plane and the stiffness of the material behind it.
struct PlaneTraction {
  double normal, tangential;                      ///< Pa
  double normal_stiffness, tangential_stiffness;  ///< diagonal of Q_e: lambda + 2G and G, Pa
};

/// The effective traction N on a plane (Pa) and its gradient dN/d(traction), m of eq. 16 over its length in
/// mode I.
struct PlaneDrive {
  double traction, normal, tangential;
};

/// The softening law of eqs. 13-18 on one plane. Unless pressure counts, only tensile normal traction drives
/// decohesion.
class DecohesionLaw {
 public:
  DecohesionLaw() = default;
  explicit DecohesionLaw(const DecohesionParameters& parameters)
      : parameters_(parameters), shear_weight_(1.0 / (parameters.mode_ratio * parameters.mode_ratio)) {}

  /// Of the normal traction, what drives decohesion, Pa.
  double driving(double normal) const { return parameters_.pressure_counts ? normal : std::max(normal, 0.0); }
  /// N = sqrt(<tau_n>^2 + (tau_t/C_m)^2), Pa: the effective traction over u0 (eq. 15 with tau_bar_0 =
  /// tau_np).
  double effective_traction(double normal, double tangential) const {
    const double n = driving(normal);
    return std::sqrt(n * n + shear_weight_ * tangential * tangential);
  }
  /// The same with its gradient. pulled: the normal traction counts (whatever its sign: the branch is chosen
  /// outside).
  PlaneDrive drive(double normal, double tangential, bool pulled) const {
    const double n = pulled ? normal : 0.0;
    const double N = std::sqrt(n * n + shear_weight_ * tangential * tangential);
    if (!(N > 0.0)) return {0.0, 1.0, 0.0};
    return {N, n / N, shear_weight_ * tangential / N};
  }
  /// tau_np (1 - lambda^q): the traction that the plane still carries, Pa.
  double strength(double decohesion, double onset_strength) const {
    return onset_strength * (1.0 - power(decohesion));
  }
  /// d strength / d lambda, Pa (negative; -infinity at lambda = 0 for q < 1).
  double strength_slope(double decohesion, double onset_strength) const {
    const double q = parameters_.q;
    return q == 1.0 ? -onset_strength : -onset_strength * q * std::pow(decohesion, q - 1.0);
  }
  /// Energy per area that eq. 13 dissipates from lambda0 to lambda1, J/m^2 (U0/2 in all for q = 1), whatever
  /// the mode.
  double surface_energy(double lambda0, double lambda1, double onset_strength) const {
    const double q1 = parameters_.q + 1.0;
    return opening(onset_strength) * onset_strength *
           (lambda1 - lambda0 - (std::pow(lambda1, q1) - std::pow(lambda0, q1)) / q1);
  }

  struct Advance {
    double decohesion;                          ///< lambda at the end
    double normal_opening, tangential_opening;  ///< increments, m
    bool separates;                             ///< no equilibrium is left before lambda = 1
  };
  /// Implicit step from lambda0 under a trial traction that exceeds the strength. length: L_e, m; duration: s
  /// (used with a viscosity only).
  Advance advance(double lambda0, double onset_strength, const PlaneTraction& trial, double length,
                  double duration) const;

  /// Denominator of the rate of lambda (eqs. 12-13), [m.Q.m/L_e - U0 q lambda^(q-1)] / u0^2, Pa/m; <= 0:
  /// snap-back.
  double hardening_denominator(double lambda, double onset_strength, const PlaneTraction& traction,
                               double length) const;

  const DecohesionParameters& parameters() const { return parameters_; }
  bool is_dust() const {
    return parameters_.separated == Separated::nothing || parameters_.separated == Separated::removed;
  }
  bool has_faces() const { return parameters_.separated == Separated::faces; }
  /// Whether a localised point may flow: the material behind the plane, or rubble.
  bool flows(bool is_separated) const {
    return is_separated && !has_faces() ? parameters_.separated == Separated::drucker_prager
                                        : parameters_.flow_behind_plane;
  }
  double friction() const { return parameters_.friction; }
  double viscosity() const { return parameters_.viscosity; }
  /// Opening of a plane in pure mode I at lambda = 1, m: U0 / tau_np, which is u0 unless tau_bar_0 is given.
  double opening(double onset_strength) const {
    return parameters_.tau_bar_0 ? parameters_.opening * *parameters_.tau_bar_0 / onset_strength
                                 : parameters_.opening;
  }

 private:
  double power(double lambda) const {
    return parameters_.q == 1.0 ? lambda : std::pow(lambda, parameters_.q);
  }

  DecohesionParameters parameters_;
  double shear_weight_ = 1.0;  // 1 / C_m^2
};

}  // namespace vitrum
