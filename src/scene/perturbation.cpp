#include "scene/perturbation.hpp"

#include <random>

namespace vitrum {

std::vector<Vector2> displacements(const Perturbation& perturbation, double cell, std::size_t count) {
  std::vector<Vector2> shifts(count, Vector2{0.0, 0.0});
  if (!(perturbation.amplitude > 0.0)) return shifts;
  std::mt19937_64 bits(static_cast<std::uint64_t>(perturbation.seed));
  // The standard fixes the engine's bits but not those of its distributions.
  constexpr double unit = 1.0 / 9007199254740992.0;  // 2^-53
  for (Vector2& shift : shifts)
    for (double& component : shift)
      component =
          perturbation.amplitude * cell * (2.0 * (static_cast<double>(bits() >> 11) + 0.5) * unit - 1.0);
  return shifts;
}

}  // namespace vitrum
