#pragma once
#include <vector>

#include "mpm/chunk.hpp"
#include "mpm/system.hpp"

namespace vitrum::mpm {

/// Strain and spin increments of a chunk (as in Particles).
struct ChunkIncrements {
  ChunkIncrements() {}  // filled, not cleared
  double strain[4][Chunk::capacity], spin[Chunk::capacity];
};

/// What most reports come down to. Close together, because one thread reads those of all: what it has read of
/// another's, that one gets back slowly.
struct BriefReport {
  double elastic = 0.0;  ///< J
  bool more = false;     ///< there is more in the report itself
};

/// Takes particles over their strain increments tile by tile. What the tiles did is booked in their order, so
/// that the record does not depend on how particles are stored or on threads.
class StressUpdate {
 public:
  StressUpdate(System& system, double duration);

  /// Before the chunks of a tile. Called from several threads, for different tiles, as `take`.
  void start(std::size_t tile);
  /// A chunk of a body in a tile.
  void take(std::size_t tile, std::size_t body, const Chunk& chunk, const ChunkIncrements& increments);
  /// After them.
  void finish(std::size_t tile);
  /// Fills the energies and events of system.record. Throws PointFailure.
  void book();

 private:
  System& system_;
  double duration_;
  std::vector<ParticleColumns> columns_;  // by body
  std::vector<BatchReport>& reports_;     // by tile and body
  std::vector<BriefReport>& brief_;       // the same
};

}  // namespace vitrum::mpm
