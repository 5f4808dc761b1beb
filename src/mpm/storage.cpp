#include "mpm/storage.hpp"

#include <numeric>

#include "mpm/grid.hpp"

namespace vitrum::mpm {
namespace {

/// Puts column[order[i]] at place i.
template <class T>
void reorder(std::vector<T>& column, const std::vector<std::uint32_t>& order) {
  static thread_local std::vector<T> old;
  if (column.empty()) return;
  old.resize(column.size());
  old.swap(column);
  for (std::size_t i = 0; i < order.size(); ++i) column[i] = old[order[i]];
}

}  // namespace

void reorder(Particles& p, const std::vector<std::uint32_t>& order) {
  const auto all = [&](auto& columns) {
    for (auto& column : columns) reorder(column, order);
  };
  all(p.position), all(p.velocity), all(p.elastic_strain), all(p.stress), all(p.variables);
  reorder(p.mass, order), reorder(p.identity, order);
}

void Grid::sort_storage(std::vector<Body>& bodies) {
  for (std::size_t body = 0; body < body_count_; ++body) {
    if (bodies[body].coasting) continue;
    place_.clear();  // the particles in their new order
    for (std::size_t tile = 0; tile < tile_block_.size(); ++tile) {
      const auto [begin, end, contiguous] = particles(tile, body);
      const auto first = static_cast<std::uint32_t>(place_.size());
      place_.insert(place_.end(), begin, end);
      std::iota(index_.begin() + offset_[tile * body_count_ + body],
                index_.begin() + offset_[tile * body_count_ + body + 1], first);
    }
    reorder(bodies[body].particles, place_);
  }
  std::fill(contiguous_.begin(), contiguous_.end(), char{1});
}

}  // namespace vitrum::mpm
