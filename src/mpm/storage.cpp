#include "mpm/storage.hpp"

#include <algorithm>
#include <numeric>
#include <span>

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
class alignas(64) Part {
 public:
  /// The lists [first, last): of these tiles, those of all bodies one after the other. List n has the places
  /// of its particles in index[offset[n]] to index[offset[n + 1]], on return the new ones. Copies what other
  /// parts are about to overwrite.
  void collect(const std::vector<Body>& bodies, const std::uint32_t* offset, std::uint32_t* index,
               std::size_t first, std::size_t last);
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

void Part::collect(const std::vector<Body>& bodies, const std::uint32_t* offset, std::uint32_t* index,
                   std::size_t first, std::size_t last) {
  stretches_.resize(bodies.size());
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    Stretch& s = stretches_[body];
    s.from.clear(), s.foreign.clear(), s.values.clear();
    s.begin = 0;
    for (std::size_t n = body; n < first; n += bodies.size()) s.begin += offset[n + 1] - offset[n];
    for (std::size_t n = first + body; n < last; n += bodies.size()) {
      std::uint32_t *const list = index + offset[n], *const end = index + offset[n + 1];
      const auto place = static_cast<std::uint32_t>(s.begin + s.from.size());
      s.from.insert(s.from.end(), list, end);
      std::iota(list, end, place);
    }
    const auto begin = static_cast<std::uint32_t>(s.begin), size = static_cast<std::uint32_t>(s.from.size());
    for (std::uint32_t k = 0; k < size; ++k)
      if (s.from[k] - begin >= size) s.foreign.push_back(k);  // (places before wrap around)
    s.values.reserve(s.foreign.size() * (10 + bodies[body].particles.variables.size()));
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

void Grid::sort_storage(std::vector<Body>& bodies, parallel::ThreadTeam& team, std::size_t count) {
  static thread_local std::vector<Part> parts;  // of the calling thread; workers write to them
  parts.resize(count);
  const std::span<Part> all_parts = parts;  // (a thread-local name means something else in each thread)
  team.on_each_thread([&](std::size_t n) {
    if (n < count)
      all_parts[n].collect(bodies, offset_.data(), index_.data(), first_tile_of(n, count) * body_count_,
                           first_tile_of(n + 1, count) * body_count_);
  });
  team.on_each_thread([&](std::size_t n) {
    if (n < count) all_parts[n].place(bodies);
  });
  scattered_ = 0, ++times_sorted_;
}

}  // namespace vitrum::mpm
