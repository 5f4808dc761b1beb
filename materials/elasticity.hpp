#pragma once
#include <cmath>
#include <span>

#include "schema/fields.hpp"
#include "tensor/symmetric.hpp"

namespace vitrum {

/// Scene table [material.NAME] without its sub-tables.
struct ElasticParameters {
  double density = 0.0;  ///< kg/m^3
  double young = 0.0;    ///< Pa
  double poisson = 0.0;

  static schema::Fields<ElasticParameters> rows();
};

/// Bulk and shear modulus, Pa.
struct Moduli {
  double bulk, shear;

  constexpr double p_wave() const { return bulk + 4.0 / 3.0 * shear; }
  /// sigma = E : e
  VITRUM_INLINE constexpr SymmetricTensor stress(const SymmetricTensor& e) const {
    const double lame_trace = (bulk - 2.0 / 3.0 * shear) * trace(e);
    return {lame_trace + 2.0 * shear * e.rr, lame_trace + 2.0 * shear * e.zz, lame_trace + 2.0 * shear * e.tt,
            2.0 * shear * e.rz};
  }
  /// e = E^-1 : sigma
  constexpr SymmetricTensor strain(const SymmetricTensor& sigma) const {
    const double mean = trace(sigma) / 3.0, volumetric = mean / (3.0 * bulk), compliance = 0.5 / shear;
    return {volumetric + compliance * (sigma.rr - mean), volumetric + compliance * (sigma.zz - mean),
            volumetric + compliance * (sigma.tt - mean), compliance * sigma.rz};
  }
  /// e : E : e / 2, J per m^3 of reference volume: the stress is that of the reference volume
  /// (docs/theory/strain-and-stress.md), so that this is the work done on it at strains of any size.
  VITRUM_INLINE constexpr double energy(const SymmetricTensor& e) const {
    const double t = trace(e);
    const SymmetricTensor d = deviator(e);
    return 0.5 * bulk * t * t + shear * contract(d, d);
  }
};

constexpr Moduli elastic_moduli(const ElasticParameters& p) {
  return {p.young / (3.0 * (1.0 - 2.0 * p.poisson)), p.young / (2.0 * (1.0 + p.poisson))};
}

}  // namespace vitrum
