#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace vitrum {
struct System;
}

namespace vitrum::mpm {

class StressUpdate;

/// An operator between particles and nodes in pieces: first what it does with the particles of a tile, then
/// what it does with the nodes of a block, once all tiles that share them are done. Made by scatter_pass and
/// gather_pass (transfer.hpp).
struct Pass {
  using Piece = void (*)(const Pass&, std::size_t);

  System* system = nullptr;
  double duration = 0.0;  ///< s
  Piece tile = nullptr, block = nullptr;
  void (*finish)(const Pass&) = nullptr;  ///< once everything is done
  StressUpdate* stress = nullptr;         ///< where stress is updated
  const void* targets = nullptr;          ///< where rates or gradients go, by body
  std::vector<double>* parts = nullptr;   ///< of a sum that `finish` takes in order: by tile or by block
};

/// Takes passes one after the other as one wave over the strips of the grid (wave.hpp).
void sweep(System& system, std::span<const Pass> passes);

}  // namespace vitrum::mpm
