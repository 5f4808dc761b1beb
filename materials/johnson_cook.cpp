#include "materials/johnson_cook.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/root.hpp"
#include "schema/field.hpp"

namespace vitrum {
using intervals::fraction, intervals::not_negative, intervals::positive;
using schema::required;

schema::Fields<JohnsonCookParameters> JohnsonCookParameters::rows() {
  using P = JohnsonCookParameters;
  return {
      {"A", &P::A, "Pa", positive, "yield strength at the reference rate and temperature", required},
      {"B", &P::B, "Pa", not_negative, "hardening", required},
      {"n", &P::n, "1", {0.0, 10.0, true}, "exponent of the plastic strain", required},
      {"C", &P::C, "1", fraction, "factor of the logarithm of the rate"},
      {"m", &P::m, "1", {0.0, 10.0, true}, "exponent of the homologous temperature T*", required},
      {"reference_rate", &P::reference_rate, "1/s", positive,
       "rate of plastic strain below which C counts for nothing"},
      {"reference_temperature", &P::reference_temperature, "K", not_negative, "temperature at which T* is 0"},
      {"melting_temperature", &P::melting_temperature, "K", positive, "temperature at which T* is 1",
       required},
      {"temperature", &P::temperature, "K", not_negative, "temperature at the start"},
      {"heat_capacity", &P::heat_capacity, "J/(kg K)", positive, "specific heat", required},
      {"heat_fraction", &P::heat_fraction, "1", fraction,
       "share of the plastic work that heats the material; 0: isothermal"},
  };
}

JohnsonCook::JohnsonCook(const ElasticParameters& elastic, const Parameters& parameters, double /*cell*/)
    : parameters_(parameters),
      elastic_(elastic_moduli(elastic)),
      kelvin_per_work_(parameters.heat_fraction / (elastic.density * parameters.heat_capacity)) {}

std::optional<Contradiction> JohnsonCook::contradiction(const ElasticParameters&, const Parameters& p) {
  const auto kelvin = [](double T) { return " (" + std::to_string(std::lround(T)) + " K)"; };
  if (!(p.melting_temperature > p.reference_temperature))
    return Contradiction{"melting_temperature",
                         "more than reference_temperature" + kelvin(p.reference_temperature)};
  if (!(p.temperature < p.melting_temperature))
    return Contradiction{"temperature", "less than melting_temperature" + kelvin(p.melting_temperature)};
  return std::nullopt;
}

std::vector<Variable> JohnsonCook::all_variables() {
  return {
      {.name = "equivalent_plastic_strain",
       .unit = "1",
       .text = "equivalent plastic strain, the integral of (2/3 d:d)^(1/2)",
       .scale = 1.0e-2,
       .bounds = not_negative},
      {.name = "temperature", .unit = "K", .text = "temperature", .scale = 100.0, .bounds = not_negative}};
}

std::vector<Variable> JohnsonCook::variables() const {
  std::vector<Variable> list = all_variables();
  list.back().initial = parameters_.temperature;
  if (!heats()) list.pop_back();
  return list;
}

double JohnsonCook::strength(double plastic_strain, double rate, double temperature) const {
  const Parameters& p = parameters_;
  const double hardened = p.A + p.B * std::pow(plastic_strain, p.n);
  const double faster = 1.0 + p.C * std::log(std::max(rate / p.reference_rate, 1.0));
  const double warmer = temperature - p.reference_temperature,
               homologous = std::clamp(warmer / (p.melting_temperature - p.reference_temperature), 0.0, 1.0);
  return hardened * faster * (1.0 - std::pow(homologous, p.m));
}

/// The strength is that of the end of the increment (backward Euler); a jump is as slow as the reference
/// rate.
void JohnsonCook::advance(State& s, const SymmetricTensor& strain, double duration,
                          PointReport& report) const {
  const double G = elastic_.shear, temperature = heats() ? s.temperature : parameters_.temperature;
  const auto equivalent_stress = [G](const SymmetricTensor& e) {
    const SymmetricTensor d = deviator(e);
    return 2.0 * G * std::sqrt(1.5 * contract(d, d));
  };
  const SymmetricTensor before = s.elastic_strain;
  const double start = equivalent_stress(before);
  s.elastic_strain += strain;
  const double trial = equivalent_stress(s.elastic_strain);
  if (!(trial > 0.0) || (duration == 0.0 && parameters_.C > 0.0)) return;
  const double slow = strength(s.plastic_strain, 0.0, temperature);
  if (!(trial > slow)) return;

  // Plastic work: at the mean of the stress at which the flow began and that of the end.
  const double began = std::clamp(start, slow, trial);
  const auto work = [&](double flow) { return flow * 0.5 * (began + trial - 3.0 * G * flow); };
  const auto strength_in_excess = [&](double flow) {
    const double rate = flow > 0.0 && parameters_.C > 0.0 ? flow / duration : 0.0;
    return strength(s.plastic_strain + flow, rate, temperature + kelvin_per_work_ * work(flow)) -
           (trial - 3.0 * G * flow);
  };
  // The stress falls to the slow strength at most, unless heat takes of that.
  double most = (trial - slow) / (3.0 * G);
  if (strength_in_excess(most) < 0.0) most = trial / (3.0 * G);
  const double flow = rising_root(0.0, most, strength_in_excess), dissipated = work(flow);
  const SymmetricTensor direction = (1.0 / trial) * deviator(s.elastic_strain);
  s.elastic_strain -= 3.0 * G * flow * direction;
  constexpr double on_surface = 1e-9;
  if (s.plastic_strain == 0.0 || start < (1.0 - on_surface) * slow) {
    const double at = std::clamp((slow - start) / (trial - start), 0.0, 1.0);
    report.record(EventKind::yield, at, elastic_.stress(before + at * strain));
  }
  s.plastic_strain += flow;
  if (heats()) s.temperature += kelvin_per_work_ * dissipated;
  report.dissipation.plastic += dissipated;
}

}  // namespace vitrum
