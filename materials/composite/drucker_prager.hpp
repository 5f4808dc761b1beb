#pragma once
#include <span>

#include "materials/composite/von_mises.hpp"
#include "materials/elasticity.hpp"
#include "schema/fields.hpp"

namespace vitrum {

/// Scene table [material.NAME.drucker_prager]: perfect plasticity under compression, eq. 19.
struct DruckerPragerParameters {
  double yield = 0.0;       ///< sigma_y, Pa
  double beta = 0.0;        ///< pressure sensitivity
  bool associated = false;  ///< flow = "associated"; otherwise "isochoric"

  static schema::Fields<DruckerPragerParameters> rows();
};

/// The law of eq. 19, q - (sigma_y + beta P) = 0, where P >= 0. (The squared form of the paper has a second
/// nappe.)
class DruckerPragerLaw {
 public:
  DruckerPragerLaw() = default;
  explicit DruckerPragerLaw(const DruckerPragerParameters& parameters)
      : parameters_(parameters), dilatancy_(parameters.associated ? parameters.beta : 0.0) {}

  /// q - (sigma_y + beta P), Pa, of an elastic strain.
  VITRUM_INLINE double yield_function(const SymmetricTensor& elastic_strain, const Moduli& moduli) const {
    const SymmetricTensor d = deviator(elastic_strain);
    const double q = 2.0 * moduli.shear * std::sqrt(1.5 * contract(d, d));
    return q - (parameters_.yield - parameters_.beta * moduli.bulk * trace(elastic_strain));
  }

  /// Returns a trial elastic strain to the surface and adds to `plastic_strain` (the integral of |d eps_p|).
  /// `violated_before`: f at the start of the increment, Pa; what exceeds zero there flows at once, the rest
  /// along the surface.
  PlasticReturn flow(SymmetricTensor& elastic_strain, const Moduli& moduli, double violated_before,
                     double& plastic_strain) const;

  double dilatancy() const { return dilatancy_; }

 private:
  DruckerPragerParameters parameters_;
  double dilatancy_ = 0.0;  // beta_psi: volumetric plastic strain per unit of the multiplier
};

}  // namespace vitrum
