#include "materials/composite/elastic_limit.hpp"

#include <algorithm>
#include <cmath>

#include "materials/composite/damage.hpp"

namespace vitrum {

double elastic_limit(const MaterialParameters& parameters) {
  double limit = 1.0;
  const double young = parameters.elastic.young;
  if (parameters.von_mises) limit = std::min(limit, parameters.von_mises->yield / young);
  if (parameters.drucker_prager && parameters.drucker_prager->yield > 0.0)
    limit = std::min(limit, parameters.drucker_prager->yield / young);
  if (parameters.damage) {
    const DamageLaw law(*parameters.damage, parameters.elastic);
    const double strain = std::pow(
        0.1 * crack_density_limit / law.coefficient(law.effective_rate(1.0e3)), 1.0 / law.exponent());
    limit = std::min(limit, law.trace_of(strain));
  }
  return limit < 1.0 ? limit : 1.0e-3;
}

}  // namespace vitrum
