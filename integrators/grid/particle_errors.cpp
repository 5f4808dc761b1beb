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
  for_each_part([&](const Part& part, std::size_t) {
    const auto [n, begin, end] = part;
    for (std::size_t a = 0; a < strain; ++a)
      std::fill(weights + place(n, a) + begin, weights + place(n, a) + end,
                1.0 / tolerance_of(quantity_of(a), n, 0));
    double* of_strain = weights + place(n, strain);
    for (std::size_t i = begin; i < end; ++i) of_strain[i] = 1.0 / tolerance_of(Quantity::strain, n, i);
    for (std::size_t a = strain + 1; a < arrays(); ++a)
      std::copy(of_strain + begin, of_strain + end, weights + place(n, a) + begin);
  });
  // Works and impulses follow from the others; they steer nothing.
  std::fill(weights + tail_, weights + size_, 0.0);
}

void ParticleSystem::add_errors(const double* errors, ErrorEstimate& estimate) const {
  using Squares = std::array<double, 3>;  // of relative errors, summed, by quantity
  std::vector<Squares> squares(parts_.size(), Squares{});
  for_each_part([&](const Part& part, std::size_t k) {
    const auto [n, begin, end] = part;
    const double* last_strain = last_strain_[n].data();
    for (std::size_t a = 0; a < arrays(); ++a) {
      const double* error = errors + place(n, a);
      const bool of_strain = quantity_of(a) == Quantity::strain;
      const double scale = tolerance_of(quantity_of(a), n, begin) / tolerance_;
      double sum = 0.0;
#pragma omp simd reduction(+ : sum)
      for (std::size_t i = begin; i < end; ++i) {
        const double relative = error[i] / (of_strain ? scales_.strain + last_strain[i] : scale);
        sum += relative * relative;
      }
      squares[k][static_cast<std::size_t>(quantity_of(a))] += sum;
    }
  });
  Squares sums{};
  for (const Squares& of_part : squares)
    for (std::size_t q = 0; q < sums.size(); ++q) sums[q] += of_part[q];
  const auto particles = static_cast<double>(system_.particle_count());
  const double vectors = 2.0 * particles, strains = static_cast<double>(arrays() - strain) * particles;
  estimate.position += std::sqrt(sums[0] / vectors);
  estimate.velocity += std::sqrt(sums[1] / vectors);
  estimate.strain += std::sqrt(sums[2] / strains);
  estimate.total += std::sqrt((sums[0] + sums[1] + sums[2]) / (2.0 * vectors + strains));
}

double ParticleSystem::tolerance_of(std::size_t unknown) const {
  if (unknown >= tail_) return std::numeric_limits<double>::infinity();
  for (std::size_t n = system_.bodies.size(); n-- > 0;)
    if (unknown >= first_[n]) {
      const std::size_t particles = system_.bodies[n].particles.size, at = unknown - first_[n];
      return tolerance_of(quantity_of(at / particles), n, at % particles);
    }
  return tolerance_;
}

std::string ParticleSystem::describe(std::size_t unknown) const {
  if (unknown >= tail_) return works_ && unknown == tail_ ? "external work" : "impulse of contact";
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
