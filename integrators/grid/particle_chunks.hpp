#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>

#include "mpm/system.hpp"

namespace vitrum {

/// Calls f(begin, end) for particles of a body, few at a time, on all threads. The chunks are those of
/// mpm::try_stress and mpm::update_stress: but for help, threads have the same particles here and there.
template <class F>
void for_particles(const System& system, std::size_t body, F&& f) {
  constexpr std::size_t most = 256;
  const std::size_t size = system.bodies[body].particles.size;
  system.team->for_each_chunk((size + most - 1) / most,
                              [&](std::size_t k) { f(k * most, std::min(size, (k + 1) * most)); });
}

/// To be raised by any of several threads.
class Flag {
 public:
  void raise() {
    if (!raised()) raised_.store(true, std::memory_order_relaxed);
  }
  bool raised() const { return raised_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> raised_{false};
};

}  // namespace vitrum
