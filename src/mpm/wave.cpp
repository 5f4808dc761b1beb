#include "mpm/wave.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace vitrum::mpm {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Pieces whose stage may be taken.
struct Ready {
  std::size_t stage, begin, end;
};
struct Piece {
  std::size_t stage, piece;
};

/// What a thread has before it, and what it has behind it.
class alignas(64) Workload {
 public:
  /// Begins with the pieces of a share; downwards: with the last of them.
  void start(bool downwards, std::size_t begin, std::size_t end) {
    ready_.clear(), first_ = 0;  // (an exception may have left some)
    downwards_ = downwards;
    some_ = false;
    over_ = 0;
    seconds_ = 0.0;
    add({0, begin, end});
  }
  void add(const Ready& ready) {
    if (ready.begin == ready.end) return;
    const std::lock_guard lock(mutex_);
    if (first_ == ready_.size()) ready_.clear(), first_ = 0;
    ready_.push_back(ready);
    some_.store(true, std::memory_order_relaxed);
  }
  /// For the thread itself: it goes on with what it has just made ready.
  std::optional<Piece> newest() { return take(true); }
  /// For those who help: what the thread will come to last.
  std::optional<Piece> oldest() { return take(false); }

  /// Pieces that the thread has taken through their last stage.
  std::size_t over() const { return over_.load(std::memory_order_acquire); }
  void count_over() { over_.store(over_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  /// What the pieces of the share have cost, s; who has taken them does not matter.
  double seconds() const { return seconds_.load(std::memory_order_relaxed); }
  void count_seconds(double more) { seconds_.fetch_add(more, std::memory_order_relaxed); }

 private:
  /// newest: the newest of what is ready, from the end where the thread is; else the oldest, from the other.
  std::optional<Piece> take(bool newest) {
    if (!some_.load(std::memory_order_relaxed)) return {};  // (a look, not a promise)
    const std::lock_guard lock(mutex_);
    if (first_ == ready_.size()) return {};
    Ready& ready = newest ? ready_.back() : ready_[first_];
    const Piece piece{ready.stage, newest != downwards_ ? ready.begin++ : --ready.end};
    if (ready.begin == ready.end) {
      if (newest)
        ready_.pop_back();
      else
        ++first_;
    }
    some_.store(first_ != ready_.size(), std::memory_order_relaxed);
    return piece;
  }

  std::mutex mutex_;
  std::vector<Ready> ready_;  // from first_ on
  std::size_t first_ = 0;
  bool downwards_ = false;
  std::atomic<bool> some_{false};
  alignas(64) std::atomic<std::size_t> over_{0};  // looked at by those who wait
  std::atomic<double> seconds_{0.0};
};

/// By stage, the pieces around a line that must be done before. No two lines share a cache line.
struct alignas(64) Awaited {
  std::array<std::atomic<std::uint32_t>, Wave::most_stages> pieces;
};

}  // namespace

struct Wave::Shared {
  std::span<const std::size_t> lines, shares;
  std::size_t count = 0, stages = 0;
  Call call = nullptr;
  void* context = nullptr;
  std::vector<std::size_t> line_of;  // by piece
  std::vector<Awaited> awaited;      // by line
  std::vector<Workload> workloads;   // by thread
  std::vector<double> seconds;       // by thread, for its share
  std::atomic<bool> stopped{false};

  void prepare(std::size_t threads);
  void work(std::size_t thread);
  void take(const Piece& piece, std::size_t thread);
  bool help(std::size_t thread);
  bool is_over() const;
  void finish(const Piece& piece, std::size_t thread);
  void make_ready(std::size_t stage, std::size_t line);
  std::size_t before(std::size_t line) const { return line == 0 ? 0 : line - 1; }
  std::size_t after(std::size_t line) const { return line + 1 == count ? line : line + 1; }
};

Wave::Wave() = default;
Wave::~Wave() = default;
Wave::Wave(Wave&&) noexcept = default;
Wave& Wave::operator=(Wave&&) noexcept = default;

void Wave::Shared::prepare(std::size_t threads) {
  line_of.resize(lines[count]);
  for (std::size_t line = 0; line < count; ++line)
    for (std::size_t piece = lines[line]; piece < lines[line + 1]; ++piece) line_of[piece] = line;
  if (awaited.size() < count) awaited = std::vector<Awaited>(count);
  for (std::size_t line = 0; line < count; ++line)
    for (std::size_t stage = 1; stage < stages; ++stage)
      awaited[line].pieces[stage].store(
          static_cast<std::uint32_t>(lines[after(line) + 1] - lines[before(line)]),
          std::memory_order_relaxed);
  if (workloads.size() != threads) workloads = std::vector<Workload>(threads);
  for (std::size_t n = 0; n < threads; ++n) workloads[n].start(n % 2 == 1, shares[n], shares[n + 1]);
  stopped = false;
}

void Wave::Shared::take(const Piece& piece, std::size_t thread) {
  try {
    call(context, piece.stage, piece.piece);
    finish(piece, thread);  // which may want memory
  } catch (...) {
    stopped = true;
    throw;
  }
}

/// Takes what another thread has not come to, if there is any.
bool Wave::Shared::help(std::size_t thread) {
  for (std::size_t k = 1; k < workloads.size(); ++k) {
    Workload& other = workloads[(thread + k) % workloads.size()];
    const std::optional<Piece> piece = other.oldest();
    if (!piece) continue;
    const Clock::time_point start = Clock::now();
    take(*piece, thread);
    other.count_seconds(seconds_since(start));
    return true;
  }
  return false;
}

bool Wave::Shared::is_over() const {
  std::size_t over = 0;
  for (const Workload& of_thread : workloads) over += of_thread.over();
  return over == lines[count];
}

/// Makes ready what has waited for the piece as the last one.
void Wave::Shared::finish(const Piece& done, std::size_t thread) {
  const std::size_t stage = done.stage + 1, of = line_of[done.piece];
  if (stage == stages) return workloads[thread].count_over();
  for (std::size_t line = before(of); line <= after(of); ++line)
    if (awaited[line].pieces[stage].fetch_sub(1, std::memory_order_acq_rel) == 1) make_ready(stage, line);
}

/// Every piece goes to the thread whose share it is in: its data are in that thread's cache.
void Wave::Shared::make_ready(std::size_t stage, std::size_t line) {
  const std::size_t begin = lines[line], end = lines[line + 1];
  const auto first = std::upper_bound(shares.begin(), shares.end(), begin) - shares.begin() - 1;
  for (auto n = static_cast<std::size_t>(first); n < workloads.size() && shares[n] < end; ++n)
    workloads[n].add({stage, std::max(begin, shares[n]), std::min(end, shares[n + 1])});
}

void Wave::Shared::work(std::size_t thread) {
  // Who helps at once pays more for a piece's data, which are in another cache, than is saved, and the thread
  // that owns them pays again; who never does leaves all to wait for one that is held up.
  constexpr double patience = 15e-6;      // s
  constexpr unsigned looks_at_once = 64;  // some 5 ns each, a look at the clock takes longer
  Workload& own = workloads[thread];
  Clock::time_point since = Clock::now();  // the thread has been at its share, or has waited
  bool waits = false;
  for (unsigned looks = 0; !stopped.load(std::memory_order_relaxed);) {
    if (const std::optional<Piece> piece = own.newest()) {
      if (waits) since = Clock::now();
      waits = false;
      take(*piece, thread);
      continue;
    }
    if (!waits) {
      waits = true;
      const Clock::time_point now = Clock::now();
      own.count_seconds(std::chrono::duration<double>(now - since).count());
      since = now;
    }
    if (is_over()) return;
    if (++looks % looks_at_once != 0) continue;
    if (seconds_since(since) < patience || help(thread)) continue;
    std::this_thread::yield();  // another process may want the processor
  }
}

void Wave::run_together(ThreadTeam& team, std::span<const std::size_t> lines,
                        std::span<const std::size_t> shares, std::size_t stages, Call call, void* context) {
  if (stages > most_stages) throw std::logic_error("a wave has at most eight stages");
  if (stages == 0) return;
  if (!shared_) shared_ = std::make_unique<Shared>();
  Shared& shared = *shared_;
  shared.lines = lines, shared.shares = shares, shared.count = lines.size() - 1, shared.stages = stages;
  shared.call = call, shared.context = context;
  shared.prepare(static_cast<std::size_t>(team.size()));
  team.on_each_thread([&shared](std::size_t thread) { shared.work(thread); });
  shared.seconds.clear();
  for (const Workload& workload : shared.workloads) shared.seconds.push_back(workload.seconds());
  shares_.learn(shared.seconds);
}

}  // namespace vitrum::mpm
