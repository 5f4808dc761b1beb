#include "materials/maxwell.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "schema/field.hpp"

namespace vitrum {
using intervals::infinite, intervals::not_negative, intervals::positive;
using schema::required;

schema::Fields<MaxwellParameters> MaxwellParameters::rows() {
  using P = MaxwellParameters;
  return {
      {"ratios",
       &P::ratios,
       "1",
       {0.0, 1.0, true},
       "parts g_i of the instantaneous shear modulus that relax",
       required},
      {"times", &P::times, "s", positive, "their relaxation times tau_i at the reference temperature",
       required},
      {"C1", &P::C1, "1", not_negative,
       "of the shift of all times with temperature (Williams, Landel, Ferry); 0: none"},
      {"C2", &P::C2, "K", positive, "of the shift of all times with temperature"},
      {"reference_temperature", &P::reference_temperature, "K", not_negative,
       "temperature at which `times` hold"},
      {"temperature", &P::temperature, "K", not_negative, "temperature of the material, constant"},
  };
}

double MaxwellParameters::shift() const {
  const double warmer = temperature - reference_temperature;
  return std::pow(10.0, -C1 * warmer / (C2 + warmer));
}

Maxwell::Maxwell(const ElasticParameters& elastic, const Parameters& p, double /*cell*/)
    : instantaneous_(elastic_moduli(elastic)), lasting_(instantaneous_) {
  const double shift = p.shift();
  for (std::size_t i = 0; i < p.ratios.size(); ++i) {
    branches_.push_back({p.ratios[i] * instantaneous_.shear, p.times.at(i) * shift});
    lasting_.shear -= branches_.back().shear;
  }
  lasting_.shear = std::max(lasting_.shear, 0.0);  // ratios may add up to 1
}

std::optional<Contradiction> Maxwell::contradiction(const ElasticParameters&, const Parameters& p) {
  if (p.ratios.size() > most_branches)
    return Contradiction{"ratios", "at most " + std::to_string(most_branches) + " numbers"};
  if (p.times.size() != p.ratios.size())
    return Contradiction{"times",
                         "as many numbers as `ratios` has (" + std::to_string(p.ratios.size()) + ')'};
  constexpr double rounding = 1e-9;
  if (std::accumulate(p.ratios.begin(), p.ratios.end(), 0.0) > 1.0 + rounding)
    return Contradiction{"ratios", "numbers whose sum is at most 1: parts of the instantaneous modulus"};
  if (!(p.C2 + p.temperature - p.reference_temperature > 0.0))
    return Contradiction{"temperature", "more than reference_temperature - C2, where times become infinite"};
  return std::nullopt;
}

std::vector<Variable> Maxwell::all_variables() {
  std::vector<Variable> list;
  for (std::size_t i = 1; i <= most_branches; ++i)
    list.push_back({.name = "spring_" + std::to_string(i),
                    .unit = "1",
                    .text = "elastic strain of the spring of Maxwell branch " + std::to_string(i),
                    .kind = Kind::symmetric,
                    .scale = 1.0e-3});
  return list;
}

std::vector<Variable> Maxwell::variables() const {
  std::vector<Variable> list = all_variables();
  list.resize(branches_.size());
  return list;
}

/// As at the end of a jump: no spring has relaxed.
void Maxwell::start(const SymmetricTensor& stress, State& s) const {
  s.elastic_strain = instantaneous_.strain(stress);
  for (std::size_t i = 0; i < branches_.size(); ++i) s.springs[i] = deviator(s.elastic_strain);
}

namespace {

/// Factors of one branch over an increment of `duration`. With a its spring's strain, d the deviator of the
/// strain increment and y = duration / time: a ends as kept a + taken d, and the integral of |a|^2 / time
/// over the increment is start |a|^2 + cross a:d + increment |d|^2.
struct Step {
  double kept, taken, start, cross, increment;
};

Step step(double y) {
  if (!(y > 0.0)) return {1.0, 1.0, 0.0, 0.0, 0.0};
  const double relaxed = -std::expm1(-y);
  // (y - relaxed - relaxed^2 / 2) / y^2, by its series where that loses digits: the sum over k >= 3 of
  // (-1)^(k+1) (2^(k-1) - 2) / k! y^(k-2).
  double increment = (y - relaxed - 0.5 * relaxed * relaxed) / (y * y);
  if (y < 0.5) {
    increment = 0.0;
    double power = y / 6.0, two = 4.0;  // y^(k-2) / k! with its sign, 2^(k-1)
    for (int k = 3; k < 18; ++k, two *= 2.0, power *= -y / k) increment += (two - 2.0) * power;
  }
  return {1.0 - relaxed, relaxed / y, -0.5 * std::expm1(-2.0 * y), relaxed * relaxed / y, increment};
}

}  // namespace

void Maxwell::advance(State& s, const SymmetricTensor& strain, double duration, PointReport& report) const {
  s.elastic_strain += strain;
  const SymmetricTensor d = deviator(strain);
  for (std::size_t i = 0; i < branches_.size(); ++i) {
    SymmetricTensor& a = s.springs[i];
    const Step by = step(duration / branches_[i].time);
    report.dissipation.plastic +=
        2.0 * branches_[i].shear *
        (by.start * contract(a, a) + by.cross * contract(a, d) + by.increment * contract(d, d));
    a = by.kept * a + by.taken * d;
  }
}

SymmetricTensor Maxwell::stress(const State& s) const {
  SymmetricTensor sum = lasting_.stress(s.elastic_strain);
  for (std::size_t i = 0; i < branches_.size(); ++i) sum += 2.0 * branches_[i].shear * s.springs[i];
  return sum;
}

double Maxwell::stored_energy(const State& s) const {
  double sum = lasting_.energy(s.elastic_strain);
  for (std::size_t i = 0; i < branches_.size(); ++i)
    sum += branches_[i].shear * contract(s.springs[i], s.springs[i]);
  return sum;
}

}  // namespace vitrum
