#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

#include "mpm/thread_shares.hpp"
#include "mpm/thread_team.hpp"

namespace vitrum::mpm {

/// Takes work that lies in lines through stages, as a wave runs through the lines: a stage of a line is taken
/// as soon as the stage before is over for it and for the lines beside it. What a line needs is then still in
/// the cache when the next stage asks for it, and threads meet once, not after every stage. Each thread takes
/// its own share of the lines through all stages; two neighbours begin where both are ready or end where both
/// are, so that no line waits for long, and is out of the cache, when the one beside it comes.
class Wave {
 public:
  static constexpr std::size_t most_stages = 8;

  Wave();
  ~Wave();
  Wave(Wave&&) noexcept;
  Wave& operator=(Wave&&) noexcept;

  /// Calls body(stage, piece) for every stage in [0, stages) of every piece; returns when all are done.
  /// lines: line n has the pieces [lines[n], lines[n + 1]), at least one; pieces may be taken by different
  /// threads. work_before(piece): the work of all pieces before, for piece in [0, lines.back()]; never
  /// falling, the shares of the threads follow it (thread_shares.hpp). An exception ends the wave early and
  /// reaches the caller (of several, one does).
  template <class WorkBefore, class Body>
  void run(ThreadTeam& team, std::span<const std::size_t> lines, std::size_t stages,
           const WorkBefore& work_before, Body&& body) {
    if (lines.size() < 2 || team.size() == 1) {
      shares_.clear();
      if (lines.size() >= 2) run_alone(lines, stages, body);
      return;
    }
    const auto shares = shares_.divide(static_cast<std::size_t>(team.size()), lines.back(), work_before);
    run_together(
        team, lines, shares, stages,
        [](void* context, std::size_t stage, std::size_t piece) {
          (*static_cast<std::remove_reference_t<Body>*>(context))(stage, piece);
        },
        &body);
  }
  /// Where the shares of the threads began in the last run, and where the last of them ended; empty after
  /// runs of one thread or of no lines.
  std::span<const std::size_t> shares() const { return shares_.bounds(); }

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

  void run_together(ThreadTeam& team, std::span<const std::size_t> lines, std::span<const std::size_t> shares,
                    std::size_t stages, Call call, void* context);

  struct Shared;
  std::unique_ptr<Shared> shared_;  // only once several threads need it
  ThreadShares shares_;
};

}  // namespace vitrum::mpm
