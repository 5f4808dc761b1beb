#include "scene/blast.hpp"

#include <array>
#include <cmath>
#include <span>

namespace vitrum {
namespace {

/// exp of a polynomial in the logarithm of the scaled distance, up to a scaled distance.
struct Fit {
  double up_to;
  std::array<double, 7> coefficients;
};

// Swisdak (1994), table 1, metric: kPa, ms / kg^(1/3), kPa ms / kg^(1/3).
constexpr Fit pressure_fits[] = {{2.0, {9.006, -2.6893, -0.6295, 0.1011, 0.29255, 0.13505, 0.019736}},
                                 {40.0, {8.8396, -1.733, -2.64, 2.293, -0.8232, 0.14247, -0.0099}}};
constexpr Fit impulse_fits[] = {{40.0, {6.7853, -1.3466, 0.101, -0.01123}}};
constexpr Fit duration_fits[] = {{1.02, {0.5426, 3.2299, -1.5931, -5.9667, -4.0815, -0.9149}},
                                 {2.8, {0.5440, 2.7082, -9.7354, 14.3425, -9.7791, 2.8535}},
                                 {40.0, {-2.4608, 7.1639, -5.6215, 2.2711, -0.44994, 0.03486}}};
constexpr Fit arrival_fits[] = {{1.5, {-0.7604, 1.8058, 0.1257, -0.0437, -0.0310, -0.00669}},
                                {40.0, {-0.7137, 1.5732, 0.5561, -0.4213, 0.1054, -0.00929}}};

double value_of(std::span<const Fit> fits, double distance) {
  const Fit* fit = fits.data();
  while (distance > fit->up_to && fit != &fits.back()) ++fit;
  const double x = std::log(distance);
  double sum = 0.0;
  for (std::size_t k = fit->coefficients.size(); k-- > 0;) sum = sum * x + fit->coefficients[k];
  return std::exp(sum);
}

/// Impulse of a pulse over pressure times duration: integral of (1 - s) exp(-b s).
double shape_factor(double b) {
  if (std::abs(b) < 1e-3) return 0.5 - b / 6.0 + b * b / 24.0;
  return 1.0 / b - (1.0 - std::exp(-b)) / (b * b);
}

class PulseFunction final : public mpm::LoadFunction {
 public:
  explicit PulseFunction(const Pulse& pulse) : pulse_(pulse) {}
  double at(double time, const std::array<double, 2>&) const override { return pulse_.at(time); }
  double rate(double, double) const override { return 0.0; }  // of velocities alone anyone asks
  double next_kink(double time) const override {
    if (time < pulse_.arrival) return pulse_.arrival;
    const double end = pulse_.arrival + pulse_.duration;
    return time < end ? end : std::numeric_limits<double>::infinity();
  }

 private:
  Pulse pulse_;
};

}  // namespace

double Pulse::at(double time) const {
  const double s = (time - arrival) / duration;
  return s >= 0.0 && s <= 1.0 ? pressure * (1.0 - s) * std::exp(-decay * s) : 0.0;
}

double Pulse::impulse() const {
  return pressure * duration * shape_factor(decay);
}

double reflected_impulse(double charge, double standoff) {
  const double root = std::cbrt(charge);
  return value_of(impulse_fits, standoff / root) * root;  // kPa ms is Pa s
}

Pulse blast_pulse(double charge, double standoff) {
  const double root = std::cbrt(charge), distance = standoff / root;
  Pulse pulse{1e3 * value_of(pressure_fits, distance), 1e-3 * root * value_of(duration_fits, distance), 0.0,
              1e-3 * root * value_of(arrival_fits, distance)};
  // shape_factor falls with the decay.
  const double wanted = reflected_impulse(charge, standoff) / (pulse.pressure * pulse.duration);
  double low = -20.0, high = 1e4;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (shape_factor(middle) > wanted ? low : high) = middle;
  }
  pulse.decay = 0.5 * (low + high);
  return pulse;
}

std::optional<Pulse> pulse_of(const TractionDefinition& traction) {
  if (const auto& f = traction.friedlander) return Pulse{f->pressure, f->duration, f->decay, f->arrival};
  if (!traction.blast) return std::nullopt;
  Pulse pulse = blast_pulse(traction.blast->charge, traction.blast->standoff);
  pulse.arrival = traction.blast->arrival.value_or(pulse.arrival);
  return pulse;
}

std::shared_ptr<const mpm::LoadFunction> pulse_function(const Pulse& pulse) {
  return std::make_shared<PulseFunction>(pulse);
}

}  // namespace vitrum
