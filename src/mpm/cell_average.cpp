#include "mpm/cell_average.hpp"

#include <cmath>

namespace vitrum::mpm {

CellAverage::CellAverage(parallel::ThreadTeam& team, const Body& body, double cell,
                         const std::vector<char>& counted)
    : team_(team), size_(body.particles.size) {
  const Particles& p = body.particles;
  const double per_cell = 1.0 / cell, specific_volume = 1.0 / body.material->density();
  order_.reserve(p.size - static_cast<std::size_t>(std::count(counted.begin(), counted.end(), 0)));
  for (std::uint32_t i = 0; i < p.size; ++i)
    if (counted[i])
      order_.push_back({{std::floor(p.position[0][i] * per_cell), std::floor(p.position[1][i] * per_cell)},
                        p.identity[i],
                        i});
  sort();
  find_cells();
  place_.resize(order_.size()), volume_.resize(order_.size());
  std::vector<Corners> held(cells_.size());
  for_cells([&](std::size_t c) {
    held[c] = {};
    for (std::uint32_t k = cells_[c].first; k < cells_[c].last; ++k) {
      const InCell& at = order_[k];
      for (std::size_t d = 0; d < 2; ++d) place_[k][d] = p.position[d][at.particle] * per_cell - at.cell[d];
      volume_[k] = p.mass[at.particle] * specific_volume;
      const Corners N = weights(k);
      for (std::size_t n = 0; n < 4; ++n) held[c][n] += volume_[k] * N[n];
    }
  });
  corner_volume_.resize(cells_.size());
  for_cells([&](std::size_t c) { corner_volume_[c] = at_corners(cells_[c], held); });
}

/// Runs of fixed length on all threads, then pairs of runs.
void CellAverage::sort() {
  constexpr std::size_t run = 4096;
  const std::size_t size = order_.size();
  const auto place = [&](std::size_t n) {
    return order_.begin() + static_cast<std::ptrdiff_t>(std::min(n, size));
  };
  team_.for_each_chunk((size + run - 1) / run,
                       [&](std::size_t n) { std::sort(place(n * run), place((n + 1) * run)); });
  for (std::size_t width = run; width < size; width *= 2)
    team_.for_each_chunk((size + 2 * width - 1) / (2 * width), [&](std::size_t n) {
      std::inplace_merge(place(2 * n * width), place((2 * n + 1) * width), place(2 * (n + 1) * width));
    });
}

void CellAverage::find_cells() {
  const auto begins = [&](std::uint32_t k) { return k == 0 || order_[k].cell != order_[k - 1].cell; };
  std::size_t count = 0;
  for (std::uint32_t k = 0; k < order_.size(); ++k) count += begins(k) ? 1 : 0;
  cells_.reserve(count);
  std::vector<std::array<double, 2>> at;  // of the cells, sorted
  at.reserve(count);
  for (std::uint32_t k = 0; k < order_.size(); ++k) {
    if (begins(k)) cells_.push_back({k, k, {}}), at.push_back(order_[k].cell);
    cells_.back().last = k + 1;
  }
  for_cells([&](std::size_t c) {
    for (std::size_t n = 0; n < 9; ++n) {
      const std::array<double, 2> other{at[c][0] + static_cast<double>(n % 3) - 1.0,
                                        at[c][1] + static_cast<double>(n / 3) - 1.0};
      const auto found = std::lower_bound(at.begin(), at.end(), other);
      cells_[c].around[n] =
          found != at.end() && *found == other ? static_cast<std::int32_t>(found - at.begin()) : -1;
    }
  });
}

CellAverage::Corners CellAverage::weights(std::uint32_t k) const {
  const auto [right, up] = place_[k];
  return {(1.0 - right) * (1.0 - up), right * (1.0 - up), (1.0 - right) * up, right * up};
}

CellAverage::Corners CellAverage::at_corners(const Cell& cell, const std::vector<Corners>& held) const {
  Corners sums{};
  for (std::size_t corner = 0; corner < 4; ++corner)
    // The cells that meet there: to its left or right, below or above. Of each it is the opposite corner.
    for (std::size_t side = 0; side < 4; ++side) {
      const std::size_t column = corner % 2 + side % 2, row = corner / 2 + side / 2;
      if (const std::int32_t other = cell.around[3 * row + column]; other >= 0)
        sums[corner] += held[static_cast<std::size_t>(other)][3 - side];
    }
  return sums;
}

std::vector<double> CellAverage::differences(std::vector<double> q, int power) const {
  std::vector<Corners> held(cells_.size());
  for (int n = 0; n < power; ++n) {
    for_cells([&](std::size_t c) {
      held[c] = {};
      for (std::uint32_t k = cells_[c].first; k < cells_[c].last; ++k) {
        const Corners N = weights(k);
        for (std::size_t a = 0; a < 4; ++a) held[c][a] += volume_[k] * N[a] * q[order_[k].particle];
      }
    });
    for_cells([&](std::size_t c) {
      Corners mean = at_corners(cells_[c], held);
      for (std::size_t a = 0; a < 4; ++a)
        mean[a] = corner_volume_[c][a] > 0.0 ? mean[a] / corner_volume_[c][a] : 0.0;
      for (std::uint32_t k = cells_[c].first; k < cells_[c].last; ++k) {
        const Corners N = weights(k);
        q[order_[k].particle] -= N[0] * mean[0] + N[1] * mean[1] + N[2] * mean[2] + N[3] * mean[3];
      }
    });
  }
  std::vector<double> of_all(size_, 0.0);
  for (const InCell& each : order_) of_all[each.particle] = q[each.particle];
  return of_all;
}

}  // namespace vitrum::mpm
