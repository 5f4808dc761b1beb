#include "parallel/strips.hpp"

#include <algorithm>

namespace vitrum::parallel {
namespace {

/// A strip of fewer tiles is not worth a thread's asking for it.
constexpr std::size_t fewest_tiles = 2;

}  // namespace

void Strips::set(std::span<const std::int32_t> lines, std::size_t tiles) {
  pieces.clear();
  first_pieces.assign(1, 0);
  Piece strip{0, 0, tiles, tiles};
  while (strip.last_tile < tiles || strip.last_empty < lines.size()) {
    const bool tile_left = strip.last_tile < tiles, empty_left = strip.last_empty < lines.size();
    std::int32_t next = tile_left ? lines[strip.last_tile] : lines[strip.last_empty];
    if (empty_left) next = std::min(next, lines[strip.last_empty]);
    while (strip.last_tile < tiles && lines[strip.last_tile] == next) ++strip.last_tile;
    while (strip.last_empty < lines.size() && lines[strip.last_empty] == next) ++strip.last_empty;
    if (strip.last_tile - strip.first_tile < fewest_tiles) continue;
    add_strip(strip);
    strip.first_tile = strip.last_tile, strip.first_empty = strip.last_empty;
  }
  if (strip.first_tile < strip.last_tile || strip.first_empty < strip.last_empty) add_strip(strip);
}

std::size_t Strips::most_tiles_in(std::size_t strips) const {
  std::size_t most = 0;
  const std::size_t count = first_pieces.size() - 1;
  for (std::size_t first = 0; first < count; ++first) {
    const std::size_t last = std::min(first + strips, count);
    most = std::max(most, pieces[first_pieces[last] - 1].last_tile - pieces[first_pieces[first]].first_tile);
  }
  return most;
}

void Strips::add_strip(const Piece& strip) {
  const std::size_t tiles = strip.last_tile - strip.first_tile, empty = strip.last_empty - strip.first_empty,
                    count = std::max<std::size_t>(1, tiles);
  for (std::size_t n = 0; n < count; ++n)
    pieces.push_back({strip.first_tile + std::min(n, tiles), strip.first_tile + std::min(n + 1, tiles),
                      strip.first_empty + empty * n / count, strip.first_empty + empty * (n + 1) / count});
  first_pieces.push_back(pieces.size());
}

}  // namespace vitrum::parallel
