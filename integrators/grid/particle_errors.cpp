// What counts as an error of the particle system, and what its unknowns are called.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/grid/particle_system.hpp"
#include "tensor/symmetric.hpp"

namespace vitrum {

auto ParticleSystem::quantity_of(std::size_t array) -> Quantity {
  return array < velocity ? Quantity::displacement : array < strain ? Quantity::velocity : Quantity::strain;
}

double ParticleSystem::tolerance_of(Quantity quantity, std::size_t body, std::size_t particle) const {
  switch (quantity) {
    case Quantity::displacement:
      return tolerance_ * scales_.length;
    case Quantity::velocity:
      return tolerance_ * scales_.velocity;
    case Quantity::strain:
      return tolerance_ * (scales_.strain + last_strain_[body][particle]);
  }
  return tolerance_;
}

void ParticleSystem::error_weights(double* weights) const {
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    const std::size_t particles = system_.bodies[n].particles.size;
    for (std::size_t a = 0; a < strain; ++a)
      std::fill_n(weights + place(n, a), particles, 1.0 / tolerance_of(quantity_of(a), n, 0));
    for (std::size_t i = 0; i < particles; ++i) {
      const double weight = 1.0 / tolerance_of(Quantity::strain, n, i);
      for (std::size_t a = strain; a < arrays(); ++a) weights[place(n, a) + i] = weight;
    }
  }
  // The work follows from the others; it steers nothing.
  if (works_) weights[size_ - 1] = 0.0;
}

void ParticleSystem::add_errors(const double* errors, ErrorEstimate& estimate) const {
  std::array<double, 3> sums{}, counts{};
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    const std::size_t particles = system_.bodies[n].particles.size;
    for (std::size_t a = 0; a < arrays(); ++a) {
      const auto group = static_cast<std::size_t>(quantity_of(a));
      const double* of = errors + place(n, a);
      for (std::size_t i = 0; i < particles; ++i) {
        const double relative = of[i] * tolerance_ / tolerance_of(quantity_of(a), n, i);
        sums[group] += relative * relative;
      }
      counts[group] += static_cast<double>(particles);
    }
  }
  estimate.position += std::sqrt(sums[0] / counts[0]);
  estimate.velocity += std::sqrt(sums[1] / counts[1]);
  estimate.strain += std::sqrt(sums[2] / counts[2]);
  estimate.total += std::sqrt((sums[0] + sums[1] + sums[2]) / (counts[0] + counts[1] + counts[2]));
}

double ParticleSystem::tolerance_of(std::size_t unknown) const {
  if (works_ && unknown == size_ - 1) return std::numeric_limits<double>::infinity();
  for (std::size_t n = system_.bodies.size(); n-- > 0;)
    if (unknown >= first_[n]) {
      const std::size_t particles = system_.bodies[n].particles.size, at = unknown - first_[n];
      return tolerance_of(quantity_of(at / particles), n, at % particles);
    }
  return tolerance_;
}

std::string ParticleSystem::describe(std::size_t unknown) const {
  if (works_ && unknown == size_ - 1) return "external work";
  for (std::size_t n = system_.bodies.size(); n-- > 0;) {
    if (unknown < first_[n]) continue;
    const Body& body = system_.bodies[n];
    const std::size_t array = (unknown - first_[n]) / body.particles.size,
                      i = (unknown - first_[n]) % body.particles.size;
    const std::array<const char*, 2> axes =
        system_.axisymmetric ? std::array{"r", "z"} : std::array{"x", "y"};
    std::string what;
    if (array < velocity)
      what = fmt::format("displacement {}", axes[array]);
    else if (array < strain)
      what = fmt::format("velocity {}", axes[array - velocity]);
    else if (array == turn())
      what = "turn";
    else if (system_.axisymmetric)
      what = fmt::format("strain {}", std::array{"rr", "zz", "tt", "rz"}[array - strain]);
    else
      what = fmt::format("strain {}", std::array{"xx", "yy", "xy"}[array - strain]);
    return fmt::format("{} of body '{}', particle {} at ({:.6g}, {:.6g}) m", what, body.name,
                       body.particles.identity[i], body.particles.position[0][i],
                       body.particles.position[1][i]);
  }
  return "an unknown";
}

}  // namespace vitrum
