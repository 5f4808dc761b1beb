#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

#include "mpm/thread_team.hpp"

namespace vitrum::mpm {

/// Takes work that lies in lines through stages, as a wave runs through the lines: a stage of a line is taken
/// as soon as the stage before is over for it and for the lines beside it. What a line needs is then still in
/// the cache when the next stage asks for it, and threads meet once, not after every stage.
class Wave {
 public:
  Wave();
  ~Wave();
  Wave(Wave&&) noexcept;
  Wave& operator=(Wave&&) noexcept;

  /// Calls body(stage, piece) for every stage in [0, stages) of every piece; returns when all are done.
  /// lines: line n has the pieces [lines[n], lines[n + 1]), at least one; pieces may be taken by different
  /// threads. An exception ends the wave early and reaches the caller (of several, one does).
  template <class Body>
  void run(ThreadTeam& team, std::span<const std::size_t> lines, std::size_t stages, Body&& body) {
    if (lines.size() < 2) return;
    if (team.size() == 1) return run_alone(lines, stages, body);
    run_together(
        team, lines, stages,
        [](void* context, std::size_t stage, std::size_t piece) {
          (*static_cast<std::remove_reference_t<Body>*>(context))(stage, piece);
        },
        &body);
  }

 private:
  using Call = void (*)(void*, std::size_t stage, std::size_t piece);

  template <class Body>
  static void run_alone(std::span<const std::size_t> lines, std::size_t stages, Body& body) {
    const std::size_t count = lines.size() - 1;
    for (std::size_t front = 0; front + 1 < count + stages; ++front)
      for (std::size_t stage = 0; stage < stages && stage <= front; ++stage)
        if (const std::size_t line = front - stage; line < count)
          for (std::size_t piece = lines[line]; piece < lines[line + 1]; ++piece) body(stage, piece);
  }
  void run_together(ThreadTeam& team, std::span<const std::size_t> lines, std::size_t stages, Call call,
                    void* context);

  struct Shared;
  std::unique_ptr<Shared> shared_;  // only once several threads need it
};

}  // namespace vitrum::mpm
