#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "mpm/particles.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Finds the particle of a body that is nearest to a point of its surface.
class NearestParticle {
 public:
  /// particles must outlive it. spacing: m, of particles.
  NearestParticle(const Particles& particles, double spacing) : particles_(particles), spacing_(spacing) {
    for (std::uint32_t i = 0; i < particles.size; ++i) bins_[bin_of(place(i))].push_back(i);
  }

  std::uint32_t to(const Vector2& x) const {
    const auto [i0, j0] = bin_of(x);
    std::uint32_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    const auto look_at = [&](std::uint32_t i) {
      const Vector2 p = place(i);
      const double distance = std::hypot(p[0] - x[0], p[1] - x[1]);
      if (distance < least) nearest = i, least = distance;
    };
    for (long i = i0 - 2; i <= i0 + 2; ++i)
      for (long j = j0 - 2; j <= j0 + 2; ++j)
        if (const auto bin = bins_.find({i, j}); bin != bins_.end())
          for (const std::uint32_t p : bin->second) look_at(p);
    if (!(least <= 2.0 * spacing_))
      for (std::uint32_t i = 0; i < particles_.size; ++i) look_at(i);
    return nearest;
  }

 private:
  Vector2 place(std::uint32_t i) const { return {particles_.position[0][i], particles_.position[1][i]}; }
  std::pair<long, long> bin_of(const Vector2& x) const {
    return {static_cast<long>(std::floor(x[0] / spacing_)), static_cast<long>(std::floor(x[1] / spacing_))};
  }

  const Particles& particles_;
  double spacing_;
  std::map<std::pair<long, long>, std::vector<std::uint32_t>> bins_;
};

}  // namespace vitrum
