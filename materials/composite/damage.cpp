#include "materials/composite/damage.hpp"

#include <array>

namespace vitrum {
namespace {
// Gauss-Legendre on [0, 1]. Six points integrate the x ~ eps^m rise of a whole increment from zero; two
// suffice for a small one.
constexpr std::array<std::array<double, 2>, 6> six_points{{{0.03376524289842397, 0.08566224618958517},
                                                           {0.16939530676686776, 0.18038078652406930},
                                                           {0.38069040695840156, 0.23395696728634552},
                                                           {0.61930959304159844, 0.23395696728634552},
                                                           {0.83060469323313224, 0.18038078652406930},
                                                           {0.96623475710157603, 0.08566224618958517}}};
constexpr std::array<std::array<double, 2>, 2> two_points{
    {{0.21132486540518708, 0.5}, {0.78867513459481287, 0.5}}};
}  // namespace

DamageLaw::DamageLaw(const DamageParameters& parameters, const ElasticParameters& elastic)
    : parameters_(parameters), undamaged_(elastic_moduli(elastic)), poisson_(elastic.poisson) {
  const double stiffness = parameters.pressure_wave ? undamaged_.p_wave() : elastic.young;
  const double wave_speed = std::sqrt(stiffness / elastic.density);  // c of eq. 7
  const double ratio = parameters.toughness / (elastic.density * wave_speed);
  coefficient_at_unit_rate_ = 2.5 * parameters.k * ratio * ratio;
  if (parameters.volumetric) trace_per_strain_ = 1.0;
  const double rounded = std::round(parameters.m);
  if (rounded == parameters.m && rounded <= 32.0) integer_exponent_ = static_cast<unsigned>(rounded);
}

double DamageLaw::dissipation(double x0, double x1, const SymmetricTensor& e0,
                              const SymmetricTensor& e1) const {
  const double trace0 = trace(e0), trace1 = trace(e1);
  if (x1 <= x0 || trace1 <= trace0) return 0.0;
  const SymmetricTensor step = e1 - e0;
  double sum = 0.0;
  const auto add = [&](double s, double weight_s) {
    const SymmetricTensor e = e0 + s * step;
    const double t = trace(e);
    if (t <= 0.0) return;  // by rounding: where strain is all but shear a trace is the difference of equals
    // x and dx/ds on eq. 7 through its end point (x1 at trace1).
    const double x = x1 * power(t / trace1);
    const double rate = parameters_.m * x / t * (trace1 - trace0);
    const Moduli slope = moduli_derivative(x);
    const SymmetricTensor d = deviator(e);
    sum += weight_s * rate * (-0.5 * slope.bulk * t * t - slope.shear * contract(d, d));
  };
  if (x1 - x0 < 0.05 * x1)
    for (const auto& [s, w] : two_points) add(s, w);
  else
    for (const auto& [s, w] : six_points) add(s, w);
  return sum;
}

}  // namespace vitrum
