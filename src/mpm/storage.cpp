#include "mpm/storage.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "mpm/grid.hpp"

namespace vitrum::mpm {
namespace {

/// Room for a column of the calling thread's part.
template <class T>
T* room_for(std::size_t size) {
  static thread_local std::vector<T> room;
  if (room.size() < size) room.resize(size);
  return room.data();
}

/// What one thread puts into order: the particles of some tiles, which it is the one to work with.
class Part {
 public:
  /// lists: of these tiles, list after list those of the bodies, with the places of their particles; on
  /// return with the new ones. places: the new place of each list's first particle. Copies what other parts
  /// are about to overwrite.
  void collect(const std::vector<Body>& bodies, std::span<const std::span<std::uint32_t>> lists,
               std::span<const std::uint32_t> places);
  /// Puts the particles at their new places, on the same thread. All parts must have been collected. Throws
  /// nothing: the particles would be torn.
  void place(std::vector<Body>& bodies) const;

 private:
  /// The particles of a body.
  struct Stretch {
    std::size_t begin = 0;               // first of the new places
    std::vector<std::uint32_t> from;     // the old place, by new place
    std::vector<std::uint32_t> foreign;  // which come from places that are not the part's
    std::vector<double> values;          // of these, column by column
  };
  std::vector<Stretch> stretches_;  // by body
};

void Part::collect(const std::vector<Body>& bodies, std::span<const std::span<std::uint32_t>> lists,
                   std::span<const std::uint32_t> places) {
  stretches_.resize(bodies.size());
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    Stretch& s = stretches_[body];
    s.from.clear(), s.foreign.clear(), s.values.clear();
    s.begin = lists.empty() ? 0 : places[body];
    for (std::size_t n = body; n < lists.size(); n += bodies.size()) {
      s.from.insert(s.from.end(), lists[n].begin(), lists[n].end());
      std::iota(lists[n].begin(), lists[n].end(), places[n]);
    }
    const auto begin = static_cast<std::uint32_t>(s.begin), size = static_cast<std::uint32_t>(s.from.size());
    for (std::uint32_t k = 0; k < size; ++k)
      if (s.from[k] - begin >= size) s.foreign.push_back(k);  // (places before wrap around)
    s.values.reserve(s.foreign.size() * (10 + variable_count));
    for_each_column(bodies[body].particles, [&](const auto& column) {
      for (const std::uint32_t k : s.foreign)
        if (!column.empty()) s.values.push_back(static_cast<double>(column[s.from[k]]));
    });
    for (const std::uint32_t k : s.foreign) s.from[k] = begin;  // any of the part's
    room_for<double>(size), room_for<std::uint32_t>(size);
  }
}

void Part::place(std::vector<Body>& bodies) const {
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    const Stretch& s = stretches_[body];
    const double* value = s.values.data();
    for_each_column(bodies[body].particles, [&]<class T>(std::vector<T>& column) {
      if (column.empty()) return;
      const std::size_t size = s.from.size();
      T* const moved = room_for<T>(size);
      for (std::size_t k = 0; k < size; ++k) moved[k] = column[s.from[k]];
      for (const std::uint32_t k : s.foreign) moved[k] = static_cast<T>(*value++);
      std::copy(moved, moved + size, column.data() + s.begin);
    });
  }
}

}  // namespace

void Grid::sort_storage(std::vector<Body>& bodies, ThreadTeam& team, std::size_t count) {
  const std::size_t lists = offset_.size() - 1;
  static thread_local std::vector<Part> parts;  // of the calling thread; workers write to them
  static thread_local std::vector<std::span<std::uint32_t>> list;
  static thread_local std::vector<std::uint32_t> places;
  parts.resize(count), list.resize(lists), places.resize(lists);
  std::vector<std::uint32_t> next(body_count_, 0);
  for (std::size_t n = 0; n < lists; ++n) {
    list[n] = {index_.data() + offset_[n], index_.data() + offset_[n + 1]};
    places[n] = std::exchange(next[n % body_count_], next[n % body_count_] + offset_[n + 1] - offset_[n]);
  }
  // (Thread-local names mean something else in each thread.)
  const std::span<Part> all_parts = parts;
  const std::span<const std::span<std::uint32_t>> all_lists = list;
  const std::span<const std::uint32_t> all_places = places;
  team.on_each_thread([&](std::size_t n) {
    if (n >= count) return;
    const std::size_t first = first_tile_of(n, count) * body_count_,
                      size = first_tile_of(n + 1, count) * body_count_ - first;
    all_parts[n].collect(bodies, all_lists.subspan(first, size), all_places.subspan(first, size));
  });
  team.on_each_thread([&](std::size_t n) {
    if (n < count) all_parts[n].place(bodies);
  });
  scattered_ = 0;
}

}  // namespace vitrum::mpm
