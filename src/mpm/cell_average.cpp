#include "mpm/cell_average.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace vitrum::mpm {
namespace {

struct NodeHash {
  std::size_t operator()(const std::array<std::int64_t, 2>& node) const {
    return static_cast<std::size_t>(node[0]) * 0x9E3779B97F4A7C15U + static_cast<std::size_t>(node[1]);
  }
};

}  // namespace

CellAverage::CellAverage(const Body& body, double cell, const std::vector<char>& counted)
    : corners_(body.particles.size), volume_(body.particles.size, 0.0), order_(body.particles.size) {
  const Particles& p = body.particles;
  for (std::uint32_t i = 0; i < p.size; ++i) order_[p.identity[i]] = i;
  std::unordered_map<std::array<std::int64_t, 2>, std::uint32_t, NodeHash> nodes;
  const double per_cell = 1.0 / cell, specific_volume = 1.0 / body.material->density();
  for (const std::uint32_t i : order_) {
    if (!counted[i]) continue;
    volume_[i] = p.mass[i] * specific_volume;
    const double r = p.position[0][i] * per_cell, z = p.position[1][i] * per_cell;
    const double column = std::floor(r), row = std::floor(z), right = r - column, up = z - row;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t a = k % 2, b = k / 2;
      const auto [at, added] =
          nodes.try_emplace({static_cast<std::int64_t>(column) + static_cast<std::int64_t>(a),
                             static_cast<std::int64_t>(row) + static_cast<std::int64_t>(b)},
                            static_cast<std::uint32_t>(node_volume_.size()));
      if (added) node_volume_.push_back(0.0);
      const double value = (a == 0 ? 1.0 - right : right) * (b == 0 ? 1.0 - up : up);
      corners_[i].node[k] = at->second, corners_[i].value[k] = value;
      node_volume_[at->second] += volume_[i] * value;
    }
  }
}

std::vector<double> CellAverage::differences(std::vector<double> q, int power) const {
  for (std::size_t i = 0; i < q.size(); ++i)
    if (!(volume_[i] > 0.0)) q[i] = 0.0;
  std::vector<double> sums(node_volume_.size());
  for (int n = 0; n < power; ++n) {
    std::fill(sums.begin(), sums.end(), 0.0);
    for (const std::uint32_t i : order_)
      if (volume_[i] > 0.0)
        for (std::size_t k = 0; k < 4; ++k)
          sums[corners_[i].node[k]] += volume_[i] * corners_[i].value[k] * q[i];
    for (const std::uint32_t i : order_)
      if (volume_[i] > 0.0)
        for (std::size_t k = 0; k < 4; ++k)
          if (node_volume_[corners_[i].node[k]] > 0.0)
            q[i] -= corners_[i].value[k] * sums[corners_[i].node[k]] / node_volume_[corners_[i].node[k]];
  }
  return q;
}

}  // namespace vitrum::mpm
