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

template <class Columns, class Call>
void for_each_column(Columns& p, Call&& call) {
  const auto all = [&](auto& columns) {
    for (auto& column : columns) call(column);
  };
  all(p.position), all(p.velocity), all(p.elastic_strain), all(p.variables);
  call(p.mass), call(p.identity);
}

}  // namespace

void reorder(Particles& p, const std::vector<std::uint32_t>& order) {
  for_each_column(p, [&](auto& column) { reorder(column, order); });
}

void Grid::sort_storage(std::vector<Body>& bodies, ThreadTeam& team) {
  for (std::size_t body = 0; body < body_count_; ++body) {
    if (bodies[body].coasting) continue;
    place_.clear();  // the particles in their new order
    for (std::size_t tile = 0; tile < tile_block_.size(); ++tile) {
      const auto [begin, end] = particles(tile, body);
      const auto first = static_cast<std::uint32_t>(place_.size());
      place_.insert(place_.end(), begin, end);
      std::iota(index_.begin() + offset_[tile * body_count_ + body],
                index_.begin() + offset_[tile * body_count_ + body + 1], first);
    }
    Particles& p = bodies[body].particles;
    std::size_t columns = 0;
    for_each_column(p, [&](auto&) { ++columns; });
    team.for_each_chunk(columns, [&](std::size_t wanted) {
      std::size_t k = 0;
      for_each_column(p, [&](auto& column) {
        if (k++ == wanted) reorder(column, place_);
      });
    });
  }
  scattered_ = 0;
}

}  // namespace vitrum::mpm
