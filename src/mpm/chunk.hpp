#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mpm/grid.hpp"

namespace vitrum::mpm {

/// Some particles of one tile and one body, handled at a time: few enough that what is computed of them stays
/// in the innermost cache.
class Chunk {
 public:
  static constexpr std::size_t capacity = 64;

  Chunk(const std::uint32_t* list, std::size_t size)
      : list_(list), size_(size), contiguous_(consecutive(list, size)) {}

  /// Whether the particles of a list lie one behind the other in their columns.
  static bool consecutive(const std::uint32_t* list, std::size_t size) {
    std::uint32_t gaps = 0;
#pragma omp simd reduction(| : gaps)
    for (std::size_t k = 1; k < size; ++k) gaps |= list[k] - list[k - 1] - 1;
    return gaps == 0;
  }

  std::size_t size() const {
    return size_;
  }
  bool contiguous() const {
    return contiguous_;
  }
  /// Place of the k-th particle in its columns.
  std::size_t place(std::size_t k) const {
    return list_[k];
  }

 private:
  const std::uint32_t* list_;
  std::size_t size_;
  bool contiguous_;
};

/// Calls f(chunk) for all particles of a tile and body.
template <class F>
void for_chunks(const Grid& grid, std::size_t tile, std::size_t body, F&& f) {
  const Grid::Range range = grid.particles(tile, body);
  for (const std::uint32_t* at = range.begin; at < range.end; at += Chunk::capacity)
    f(Chunk(at, std::min(static_cast<std::size_t>(range.end - at), Chunk::capacity)));
}

/// What a chunk reads of a column: the column itself where the particles lie one behind the other, else a
/// copy.
class ColumnReader {
 public:
  ColumnReader(const Chunk& chunk, const double* column) {
    if (chunk.contiguous()) {
      data_ = column + chunk.place(0);
      return;
    }
    for (std::size_t k = 0; k < chunk.size(); ++k) copy_[k] = column[chunk.place(k)];
    data_ = copy_;
  }
  ColumnReader(const Chunk& chunk, const std::vector<double>& column) : ColumnReader(chunk, column.data()) {}
  ColumnReader(const ColumnReader&) = delete;
  ColumnReader& operator=(const ColumnReader&) = delete;

  double operator[](std::size_t k) const { return data_[k]; }
  /// By place in the chunk. Loops that are to be vectorised take this pointer outside.
  const double* data() const { return data_; }

 private:
  const double* data_;
  double copy_[Chunk::capacity];
};

/// The same for a column that is written. Every particle of the chunk must be.
class ColumnWriter {
 public:
  ColumnWriter(const Chunk& chunk, double* column)
      : chunk_(chunk), column_(column), data_(chunk.contiguous() ? column + chunk.place(0) : copy_) {}
  ColumnWriter(const Chunk& chunk, std::vector<double>& column) : ColumnWriter(chunk, column.data()) {}
  ~ColumnWriter() {
    if (!chunk_.contiguous())
      for (std::size_t k = 0; k < chunk_.size(); ++k) column_[chunk_.place(k)] = copy_[k];
  }
  ColumnWriter(const ColumnWriter&) = delete;
  ColumnWriter& operator=(const ColumnWriter&) = delete;

  double& operator[](std::size_t k) { return data_[k]; }
  double* data() { return data_; }

 private:
  const Chunk& chunk_;
  double* column_;
  double* data_;
  double copy_[Chunk::capacity];
};

}  // namespace vitrum::mpm
