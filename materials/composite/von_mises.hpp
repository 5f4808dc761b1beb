#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "materials/elasticity.hpp"
#include "schema/fields.hpp"
#include "tensor/vector.hpp"

namespace vitrum {

/// Scene table [material.NAME.von_mises]: linear hardening to a peak, then linear softening, eqs. 20-24.
struct VonMisesParameters {
  double yield = 0.0;      ///< sigma_y, Pa
  double peak = 0.0;       ///< sigma_p, Pa; = yield: no hardening branch
  double hardening = 0.0;  ///< E_h, Pa
  double softening = 0.0;  ///< E_s, Pa; 0: perfectly plastic from the peak on

  static schema::Fields<VonMisesParameters> rows();
};

/// What a plastic return did.
struct PlasticReturn {
  double flow = 0.0;         ///< |d eps_p| (von Mises) or the multiplier (Drucker-Prager)
  double dissipation = 0.0;  ///< J/m^3
};

/// The law of eqs. 20-24; I is the integral of |d eps_p| (eq. 23).
class VonMisesLaw {
 public:
  VonMisesLaw() = default;
  explicit VonMisesLaw(const VonMisesParameters& parameters) : parameters_(parameters) {
    const double rise = parameters.peak - parameters.yield;
    peak_strain_ = rise > 0.0 && parameters.hardening > 0.0 ? rise / parameters.hardening : 0.0;
    floor_strain_ = parameters.softening > 0.0
                        ? peak_strain_ + (1.0 - residual_fraction) * parameters.peak / parameters.softening
                        : std::numeric_limits<double>::infinity();
  }

  /// The strength never falls below this fraction of the peak (linear softening would reach zero and turn
  /// negative).
  static constexpr double residual_fraction = 1.0e-3;

  double peak_strain() const { return peak_strain_; }  ///< I_p
  double floor_strain() const { return floor_strain_; }

  /// sigma_bar of eq. 21, Pa.
  VITRUM_INLINE double strength(double plastic_strain) const {
    const double rising = parameters_.yield + parameters_.hardening * plastic_strain;
    const double falling =
        std::max(parameters_.peak - parameters_.softening * (plastic_strain - peak_strain_),
                 residual_fraction * parameters_.peak);
    return plastic_strain < peak_strain_ ? rising : falling;
  }
  /// d strength / dI on the branch that plastic flow takes from here, Pa.
  double modulus(double plastic_strain) const {
    if (plastic_strain < peak_strain_) return parameters_.hardening;
    return plastic_strain < floor_strain_ ? -parameters_.softening : 0.0;
  }
  /// Radius of the yield surface |s| = sqrt(2/3) sigma_bar, Pa.
  VITRUM_INLINE double radius(double plastic_strain) const { return factor * strength(plastic_strain); }
  /// |s| less that radius, Pa, of an elastic strain.
  VITRUM_INLINE double yield_function(const SymmetricTensor& elastic_strain, const Moduli& moduli,
                                      double plastic_strain) const {
    return 2.0 * moduli.shear * norm(deviator(elastic_strain)) - radius(plastic_strain);
  }

  /// Radial return of a trial deviator of norm `trial` (Pa) with shear modulus `shear`; raises
  /// `plastic_strain`. Exact for proportional paths over any number of branches. Zero flow where the trial is
  /// inside.
  PlasticReturn flow(double trial, double shear, double& plastic_strain) const;

  /// Work of flow on the yield surface from one plastic strain to another, the integral of the radius, J/m^3.
  double work(double from, double to) const;

  /// H |s|^2 of eq. 24, Pa.
  double tangent_drop(double shear, double plastic_strain) const {
    return tangent_drop_of(shear, modulus(plastic_strain));
  }
  /// The same for a given slope of the strength, Pa.
  static double tangent_drop_of(double shear, double modulus) {
    return 4.0 * shear * shear / (2.0 * shear + factor * modulus);
  }

  static constexpr double factor = 0.81649658092772603;  // sqrt(2/3)

 private:
  VonMisesParameters parameters_;
  double peak_strain_ = 0.0, floor_strain_ = 0.0;
};

/// The plane on which von Mises flow is closest to a discontinuity.
struct CriticalPlane {
  double severity;     ///< H times the critical 1/H, eq. 25; localises above 1
  PlaneVector normal;  ///< unit normal; both 0: hoop plane
};

/// Searches the in-plane normals (and the hoop normal where `all`) for the largest H / H_cr, eqs. 25-26.
/// deviator: s, Pa; tangent_drop: H |s|^2, Pa.
CriticalPlane von_mises_critical_plane(const SymmetricTensor& deviator, const Moduli& moduli,
                                       double tangent_drop, bool all);

}  // namespace vitrum
