#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

#include "parallel/thread_shares.hpp"
#include "parallel/thread_team.hpp"

namespace vitrum::parallel {

/// Takes work that lies in lines through stages, as a wave runs through the lines: a stage of a line is taken
/// as soon as the stage before is over for it and for the lines beside it. What a line needs is then still in
/// the cache when the next stage asks for it, and threads meet once, not after every stage. Each thread takes
/// its own share of the lines through all stages. Two neighbours begin where their shares meet, or both end
/// there, so that no line waits for long, and is out of the cache, when the one beside it comes. Two threads
/// that begin together have that behind them soon, and neither waits for the other any more.
class Wave {
 public:
  static constexpr std::size_t most_stages = 8;

  Wave();
  ~Wave();
  Wave(Wave&&) noexcept;
  Wave& operator=(Wave&&) noexcept;

  /// So many lines a thread must at least be able to have at once: one in each stage, and one whose neighbour
  /// is in the last.
  static constexpr std::size_t fewest_at_once(std::size_t stages) { return stages + 1; }

  /// Divides the pieces among the threads of a team; thread n has [shares[n], shares[n + 1]). lines: line n
  /// has the pieces [lines[n], lines[n + 1]), at least one; pieces may be taken by different threads.
  /// work_before(piece): the work of all pieces before, for piece in [0, lines.back()]; never falling, the
  /// shares follow it (thread_shares.hpp).
  template <class WorkBefore>
  std::span<const std::size_t> share_out(const ThreadTeam& team, std::span<const std::size_t> lines,
                                         const WorkBefore& work_before) {
    return shares_.divide(static_cast<std::size_t>(team.size()), lines.back(), work_before);
  }

  /// Calls body(stage, piece) for every stage in [0, stages) of every piece; returns when all are done. The
  /// lines as they have been shared out to the same team before. at_once: of the (parts of) lines in a
  /// thread's share at most so many, one beside the other, are between the beginning of their first stage and
  /// the time when they and the lines beside them have all stages behind them; a single thread has always the
  /// fewest. An exception ends the wave early and reaches the caller (of several, one does).
  template <class Body>
  void run(ThreadTeam& team, std::span<const std::size_t> lines, std::size_t stages, std::size_t at_once,
           Body&& body) {
    if (lines.size() < 2) return;
    if (team.size() == 1) return run_alone(lines, stages, body);
    run_together(
        team, lines, stages, at_once,
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

  void run_together(ThreadTeam& team, std::span<const std::size_t> lines, std::size_t stages,
                    std::size_t at_once, Call call, void* context);

  struct Shared;
  std::unique_ptr<Shared> shared_;  // only once several threads need it
  ThreadShares shares_;
};

}  // namespace vitrum::parallel
