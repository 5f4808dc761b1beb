#include "materials/johnson_holmquist.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/root.hpp"
#include "schema/field.hpp"

namespace vitrum {
using intervals::finite, intervals::fraction, intervals::infinite, intervals::not_negative,
    intervals::positive;
using schema::required;

schema::Fields<JohnsonHolmquistParameters> JohnsonHolmquistParameters::rows() {
  using P = JohnsonHolmquistParameters;
  return {
      {"A", &P::A, "1", positive, "intact strength at P + T = PHEL, in units of sigma_HEL = 1.5 (HEL - PHEL)",
       required},
      {"N", &P::N, "1", not_negative, "exponent of the pressure in the intact strength", required},
      {"B", &P::B, "1", not_negative, "fractured strength at P = PHEL, in units of sigma_HEL", required},
      {"M", &P::M, "1", not_negative, "exponent of the pressure in the fractured strength", required},
      {"fractured_limit",
       &P::fractured_limit,
       "1",
       {0.0, infinite},
       "largest fractured strength, in units of sigma_HEL"},
      {"C", &P::C, "1", fraction, "factor of the logarithm of the rate"},
      {"reference_rate", &P::reference_rate, "1/s", positive, "strain rate below which C counts for nothing"},
      {"T", &P::T, "Pa", not_negative, "largest hydrostatic tension", required},
      {"HEL", &P::HEL, "Pa", positive, "Hugoniot elastic limit", required},
      {"PHEL", &P::PHEL, "Pa", positive, "pressure at the Hugoniot elastic limit", required},
      {"D1", &P::D1, "1", not_negative, "plastic strain that fractures at P + T = PHEL", required},
      {"D2", &P::D2, "1", not_negative, "exponent of the pressure in the plastic strain that fractures",
       required},
      {"K2", &P::K2, "Pa", finite, "of mu^2 in the pressure (K1 is the bulk modulus)"},
      {"K3", &P::K3, "Pa", finite, "of mu^3 in the pressure"},
      {"beta", &P::beta, "1", fraction,
       "share of the elastic energy set free by fracture that becomes bulking"},
      {"scatter", &P::scatter, StrengthScatter::table(),
       "flaws: each point has its own T; under pressure, which closes them, they count the less the higher "
       "it is; absent: none"},
  };
}

JohnsonHolmquist::JohnsonHolmquist(const ElasticParameters& elastic, const Parameters& parameters,
                                   double /*cell*/)
    : parameters_(parameters), elastic_(elastic_moduli(elastic)) {}

std::optional<Contradiction> JohnsonHolmquist::contradiction(const ElasticParameters& elastic,
                                                             const Parameters& p) {
  if (!(p.HEL > p.PHEL)) return Contradiction{"PHEL", "less than HEL"};
  // The pressure must rise as far as half the volume. Its slope, K1 + 2 K2 mu + 3 K3 mu^2, is least at an end
  // or where it turns.
  constexpr double most = 1.0;  // mu
  const double K1 = elastic_moduli(elastic).bulk,
               turns = p.K3 > 0.0 ? std::clamp(-p.K2 / (3.0 * p.K3), 0.0, most) : most;
  for (const double mu : {turns, most})
    if (!(K1 + mu * (2.0 * p.K2 + mu * 3.0 * p.K3) > 0.0))
      return Contradiction{2.0 * p.K2 < 3.0 * p.K3 * mu ? "K2" : "K3",
                           "constants with which the pressure rises with compression, up to mu = 1"};
  return std::nullopt;
}

std::vector<Variable> JohnsonHolmquist::all_variables() {
  std::vector<Variable> list{{.name = "damage",
                              .unit = "1",
                              .text = "damage D; 1 means fractured",
                              .scale = 1.0,
                              .bounds = fraction},
                             {.name = "bulking",
                              .unit = "Pa",
                              .text = "pressure that fracture has added",
                              .scale = 1.0e8,
                              .bounds = not_negative}};
  for (const Variable& v : scatter_variables()) list.push_back(v);
  return list;
}

std::vector<Variable> JohnsonHolmquist::variables() const {
  std::vector<Variable> list = all_variables();
  if (!parameters_.scatter) list.pop_back();
  return list;
}

JohnsonHolmquist::Strength JohnsonHolmquist::strength(double pressure, double tension, double rate) const {
  const Parameters& p = parameters_;
  const double scale = 1.5 * (p.HEL - p.PHEL),
               faster = 1.0 + p.C * std::log(std::max(rate / p.reference_rate, 1.0));
  const double above_tension = (pressure + tension) / p.PHEL, compressed = pressure / p.PHEL;
  return {
      above_tension > 0.0 ? scale * faster * p.A * std::pow(above_tension, p.N) : 0.0,
      compressed > 0.0 ? scale * std::min(faster * p.B * std::pow(compressed, p.M), p.fractured_limit) : 0.0};
}

double JohnsonHolmquist::fracture_strain(double pressure, double tension) const {
  const double above_tension = (pressure + tension) / parameters_.PHEL;
  return above_tension > 0.0 ? parameters_.D1 * std::pow(above_tension, parameters_.D2) : 0.0;
}

namespace {

/// 1 - J of J = V/V0.
double compression(const SymmetricTensor& strain) {
  return -std::expm1(trace(strain));
}
double volume_ratio(const SymmetricTensor& strain) {
  return std::exp(trace(strain));
}

}  // namespace

/// Without bulking, under compression. mu = 1/J - 1.
double JohnsonHolmquist::equation_of_state(double mu) const {
  return mu * (elastic_.bulk + mu * (parameters_.K2 + mu * parameters_.K3));
}

/// Of material that bears any tension.
double JohnsonHolmquist::unlimited_pressure(const State& s) const {
  const double mu = std::expm1(-trace(s.elastic_strain));
  return s.bulking + (mu > 0.0 ? equation_of_state(mu) : elastic_.bulk * compression(s.elastic_strain));
}

double JohnsonHolmquist::pressure(const State& s) const {
  const double P = unlimited_pressure(s);
  return s.damage < 1.0 ? P : std::max(P, 0.0);
}

SymmetricTensor JohnsonHolmquist::stress(const State& s) const {
  return 2.0 * elastic_.shear * deviator(s.elastic_strain) -
         volume_ratio(s.elastic_strain) * pressure(s) * identity();
}

double JohnsonHolmquist::stored_energy(const State& s) const {
  const SymmetricTensor d = deviator(s.elastic_strain);
  const double shear = elastic_.shear * contract(d, d), c = compression(s.elastic_strain);
  if (!(c > 0.0)) {
    const double P = pressure(s);
    return shear + 0.5 * P * P / elastic_.bulk;
  }
  // The integral of the pressure over the compression, where mu is c / (1 - c): Gauss and Legendre, 8 points.
  constexpr std::array<std::array<double, 2>, 4> offsets_and_weights{
      {{0.09171732124782490, 0.18134189168918099},
       {0.26276620495816449, 0.15685332293894364},
       {0.39833323870681337, 0.11119051722668724},
       {0.48014492824876812, 0.05061426814518813}}};
  double mean = s.bulking;
  for (const auto& [offset, weight] : offsets_and_weights)
    for (const double at : {(0.5 - offset) * c, (0.5 + offset) * c})
      mean += weight * equation_of_state(at / (1.0 - at));
  return shear + c * mean + 0.5 * s.bulking * s.bulking / elastic_.bulk;
}

double JohnsonHolmquist::equivalent_stress(const SymmetricTensor& elastic_strain) const {
  const SymmetricTensor d = deviator(elastic_strain);
  return 2.0 * elastic_.shear * std::sqrt(1.5 * contract(d, d));
}

bool JohnsonHolmquist::fails_in_tension(const State& s, double pressure) const {
  return s.damage < 1.0 && pressure < 0.0 && pressure <= -tension(s) * (1.0 - s.damage);
}

/// A fracture under hydrostatic tension (Pa), which it sets free.
void JohnsonHolmquist::open_in_tension(State& s, double tension, PointReport& report) const {
  s.damage = 1.0;
  report.dissipation.damage += 0.5 * tension * tension / elastic_.bulk;
}

/// Plastic flow at the strain of `s` from an equivalent stress `trial`, until the stress is borne. The
/// strength falls linearly with the plastic strain while damage grows; where it falls faster than the stress
/// can, the point fractures at once, unless bulking stops it. Grows damage and bulking.
JohnsonHolmquist::Flow JohnsonHolmquist::flow(State& s, double trial, double rate) const {
  // Under pressure, which bulking changes, damage grows in slices.
  const bool confined = unlimited_pressure(s) >= 0.0;
  const double stiffness = 3.0 * elastic_.shear, J = volume_ratio(s.elastic_strain);
  const double slice = confined && parameters_.beta > 0.0 ? 1.0 / 256.0 : 1.0;
  const double bulking_before = s.bulking, compressed = elastic_.bulk * compression(s.elastic_strain);
  Flow f;
  double lost = 0.0;
  for (bool done = false; !done;) {
    const double P = pressure(s);
    const Strength now = strength(P, tension(s), rate);
    const double stress = trial - stiffness * f.plastic_strain, bears = J * now.at(s.damage);
    if (s.damage >= 1.0 || !(stress > bears)) {  // bulking may have raised the strength above the stress
      f.plastic_strain += std::max(stress - bears, 0.0) / stiffness;
      break;
    }
    const double to_fracture = fracture_strain(P, tension(s)), grows = std::min(slice, 1.0 - s.damage);
    const double slope = stiffness * to_fracture - J * (now.intact - now.fractured);
    const double wanted = slope > 0.0 ? (stress - bears) / slope : infinite;  // growth of damage
    done = wanted < grows;
    s.damage = done ? s.damage + wanted : std::min(s.damage + grows, 1.0);
    f.plastic_strain += std::min(wanted, grows) * to_fracture;
    if (!confined) continue;
    const double weaker = J * now.at(s.damage), end = trial - stiffness * f.plastic_strain;
    lost += std::max(bears - weaker, 0.0) * (bears + weaker) / (2.0 * stiffness);
    f.bulked = parameters_.beta * std::min(lost, 0.5 * (trial + end) * f.plastic_strain);
    const double x = compressed + bulking_before;
    s.bulking = bulking_before + std::sqrt(x * x + 2.0 * elastic_.bulk * f.bulked) - x;
  }
  f.stress = trial - stiffness * f.plastic_strain;
  return f;
}

namespace {

/// Inside the surface by more than this of the strength: an entry into flow, not its continuation.
constexpr double tolerance_of_surface = 1e-9;

/// Fraction of an increment at which something that is linear in it reaches zero from below.
double reaches_zero(double start, double end) {
  return start >= 0.0 ? 0.0 : std::clamp(start / (start - end), 0.0, 1.0);
}

}  // namespace

void JohnsonHolmquist::advance(State& s, const SymmetricTensor& strain, double duration,
                               PointReport& report) const {
  // Stresses are those of the reference volume, as the elastic strain gives them.
  const SymmetricTensor d = deviator(strain);
  const double rate = duration > 0.0 ? std::sqrt(contract(d, d) / 1.5) / duration : 0.0;
  const auto borne = [&](const State& at) {
    return volume_ratio(at.elastic_strain) * strength(pressure(at), tension(at), rate).at(at.damage);
  };
  const State start = s;
  const auto stress_at = [&](double part) {
    State at = start;
    at.elastic_strain += part * strain;
    return stress(at);
  };
  s.elastic_strain += strain;
  const double unlimited = unlimited_pressure(s);
  if (fails_in_tension(s, unlimited)) {
    // At the limit, unless the tension was beyond it to begin with.
    const double before = -unlimited_pressure(start), limit = tension(s) * (1.0 - s.damage);
    const double at = reaches_zero(before - limit, -unlimited - limit);
    if (start.damage == 0.0) report.record(EventKind::damage, at, stress_at(at));
    open_in_tension(s, std::min(-unlimited, std::max(before, limit)), report);
  }
  if (duration == 0.0 && parameters_.C > 0.0) return;  // at an infinite rate nothing flows
  const double trial = equivalent_stress(s.elastic_strain), bears = borne(s);
  if (!(trial > bears)) return;

  // The flow begins where stress and strength meet, both taken as linear over the increment.
  const double start_stress = equivalent_stress(start.elastic_strain), start_bears = borne(start),
               outside = start_stress - start_bears, flows_from = reaches_zero(outside, trial - bears);
  const double began = outside >= 0.0 ? start_stress : start_bears + flows_from * (bears - start_bears);
  if (outside < -tolerance_of_surface * start_bears)
    report.record(EventKind::yield, flows_from, stress_at(flows_from));
  const bool was_whole = s.damage == 0.0, was_intact = s.damage < 1.0;
  Flow f = flow(s, trial, rate);
  if (was_whole && s.damage > 0.0) report.record(EventKind::damage, flows_from, stress_at(flows_from));
  report.dissipation.plastic += std::max(0.5 * (began + f.stress) * f.plastic_strain - f.bulked, 0.0);
  if (was_intact && unlimited < 0.0 && (s.damage >= 1.0 || fails_in_tension(s, unlimited))) {
    open_in_tension(s, -unlimited, report);
    report.dissipation.plastic += f.stress * f.stress / (6.0 * elastic_.shear);
    f.stress = 0.0;
  }
  s.elastic_strain -= (1.0 - f.stress / trial) * deviator(s.elastic_strain);
}

/// Intact, under a stress of the reference volume.
void JohnsonHolmquist::start(const SymmetricTensor& stress, State& s) const {
  const double mean = trace(stress) / 3.0;
  const auto too_much = [&](double third) {
    State at;
    at.elastic_strain = third * identity();
    return trace(this->stress(at)) / 3.0 - mean;
  };
  constexpr double most = 0.2;  // a third of the volumetric strain
  const double third = mean == 0.0 ? 0.0 : rising_root(-most, most, too_much);
  s.elastic_strain = (0.5 / elastic_.shear) * deviator(stress) + third * identity();
}

}  // namespace vitrum
