#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

namespace vitrum::parallel {

/// Pieces [begin, end) whose stage may be taken.
struct Ready {
  std::size_t stage, begin, end;
};

/// What a thread has before it, and what it has behind it.
class alignas(64) Workload {
 public:
  /// Begins with a share of the lines [first, last); downwards: with the last of them.
  void start(bool downwards, std::size_t first, std::size_t last) {
    ready_.clear(), first_ = 0;  // (an exception may have left some)
    downwards_ = downwards;
    lines_before_ = first, lines_ = last - first, lines_over_ = 0;
    some_ = false;
    over_ = 0;
    seconds_ = 0.0;
  }
  std::size_t lines() const { return lines_; }
  /// The n-th line that the thread comes to.
  std::size_t line(std::size_t n) const { return lines_before_ + (downwards_ ? lines_ - 1 - n : n); }
  /// Calls next(n) for every line n that is over, in this order, once.
  template <class IsOver, class Next>
  void for_lines_over(const IsOver& is_over, const Next& next) {
    const std::lock_guard lock(of_lines_);
    for (; lines_over_ < lines_ && is_over(line(lines_over_)); ++lines_over_) next(lines_over_);
  }
  void add(const Ready& more) {
    if (more.begin == more.end) return;
    const std::lock_guard lock(mutex_);
    if (first_ == ready_.size()) ready_.clear(), first_ = 0;
    if (!prolong(more)) ready_.push_back(more);
    some_.store(true);  // in sequential order, for those who sleep (vigil.hpp)
  }
  /// For the thread itself: it goes on with what it has just made ready, a line or as much of a long one as
  /// leaves others something to help with. line_of, by piece.
  std::optional<Ready> newest(const std::vector<std::size_t>& line_of) { return take(true, 8, line_of); }
  /// For those who help: what lies farthest before the thread.
  std::optional<Ready> oldest(const std::vector<std::size_t>& line_of) { return take(false, 4, line_of); }

  /// Whether there is something before the thread.
  bool has_some() const { return some_.load(); }

  /// Pieces that the thread has taken through their last stage.
  std::size_t over() const { return over_.load(); }
  void count_over(std::size_t more) { over_.store(over_.load(std::memory_order_relaxed) + more); }

  /// What the pieces of the share have cost, s; who has taken them does not matter.
  double seconds() const { return seconds_.load(std::memory_order_relaxed); }
  void count_seconds(double more) { seconds_.fetch_add(more, std::memory_order_relaxed); }

 private:
  /// Pieces that continue a range join it: what a thread has before it is then taken in the order of its
  /// lines.
  bool prolong(const Ready& more) {
    for (std::size_t n = first_; n < ready_.size(); ++n) {
      Ready& ready = ready_[n];
      if (ready.stage != more.stage) continue;
      if (!downwards_ && ready.end == more.begin) return ready.end = more.end, true;
      if (downwards_ && ready.begin == more.end) return ready.begin = more.begin, true;
    }
    return false;
  }
  /// newest: the newest of what is ready, from the end where the thread is; else the oldest, from the other.
  /// At most so many pieces, all of one line.
  std::optional<Ready> take(bool newest, std::size_t most, const std::vector<std::size_t>& line_of) {
    if (!some_.load(std::memory_order_relaxed)) return {};  // (a look, not a promise)
    const std::lock_guard lock(mutex_);
    if (first_ == ready_.size()) return {};
    Ready& ready = newest ? ready_.back() : ready_[first_];
    Ready taken = ready;
    if (newest != downwards_) {
      taken.end = std::min(ready.end, ready.begin + most);
      while (line_of[taken.end - 1] != line_of[ready.begin]) --taken.end;
      ready.begin = taken.end;
    } else {
      taken.begin = std::max(ready.begin + most, ready.end) - most;
      while (line_of[taken.begin] != line_of[ready.end - 1]) ++taken.begin;
      ready.end = taken.begin;
    }
    if (ready.begin == ready.end) {
      if (newest)
        ready_.pop_back();
      else
        ++first_;
    }
    some_.store(first_ != ready_.size(), std::memory_order_relaxed);
    return taken;
  }

  std::mutex mutex_;
  std::vector<Ready> ready_;  // from first_ on
  std::size_t first_ = 0;
  bool downwards_ = false;
  std::size_t lines_before_ = 0, lines_ = 0;
  std::mutex of_lines_;
  std::size_t lines_over_ = 0;  // all before have been over, too
  std::atomic<bool> some_{false};
  alignas(64) std::atomic<std::size_t> over_{0};  // looked at by those who wait
  std::atomic<double> seconds_{0.0};
};

}  // namespace vitrum::parallel
