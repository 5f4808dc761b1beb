#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vitrum::parallel {

/// The blocks of a grid in strips of whole lines (rows, or columns): a strip shares nodes with the two beside
/// it only, and short strips leave more of them in the cache. Strips come in pieces for threads to share,
/// each as small as can be: what one thread has more than another, the other waits for.
struct Strips {
  /// A tile, unless the strip has none: the tiles [first_tile, last_tile), with their blocks (of the same
  /// numbers), and the blocks [first_empty, last_empty) that hold no particles.
  struct Piece {
    std::size_t first_tile, last_tile, first_empty, last_empty;

    template <class Call>
    void for_tiles(Call&& call) const {
      for (std::size_t tile = first_tile; tile < last_tile; ++tile) call(tile);
    }
    template <class Call>
    void for_blocks(Call&& call) const {
      for_tiles(call);
      for (std::size_t block = first_empty; block < last_empty; ++block) call(block);
    }
  };
  std::vector<Piece> pieces;
  /// Strip n has the pieces [first_pieces[n], first_pieces[n + 1]).
  std::vector<std::size_t> first_pieces{0};

  /// lines: of every block; those with tiles first, both kinds by rising line.
  void set(std::span<const std::int32_t> lines, std::size_t tiles);
  /// The most tiles that so many strips one after the other have.
  std::size_t most_tiles_in(std::size_t strips) const;

 private:
  void add_strip(const Piece& strip);
};

}  // namespace vitrum::parallel
