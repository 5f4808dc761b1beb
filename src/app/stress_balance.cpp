#include "app/stress_balance.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/stress.hpp"

namespace vitrum::app {

std::optional<StressBalance> stress_balance(const System& system, const Body& body) {
  const Particles& p = body.particles;
  const TensorColumns stress = mpm::stress_of(body);
  StressBalance balance{0.0, 0.0, 0.0};
  double volume = 0.0, middle = 0.0;
  for (std::size_t i = 0; i < p.size; ++i) {
    for (const std::vector<double>& component : stress)
      balance.largest = std::max(balance.largest, std::abs(component[i]));
    volume += p.mass[i], middle += p.mass[i] * p.position[1][i];
  }
  if (!(balance.largest > 0.0)) return std::nullopt;
  middle /= volume;
  volume /= body.material->density();
  const auto [lowest, highest] = std::ranges::minmax(p.position[1]);
  const double height = highest - lowest + 2.0 * body.particle_half_size;
  for (std::size_t i = 0; i < p.size; ++i) {
    const double across = system.axisymmetric ? 0.5 * (stress[0][i] + stress[2][i]) : stress[0][i];
    const double part = p.mass[i] / body.material->density() / volume * height;
    balance.force += part * across;
    balance.moment += part * across * (p.position[1][i] - middle);
  }
  return balance;
}

}  // namespace vitrum::app
