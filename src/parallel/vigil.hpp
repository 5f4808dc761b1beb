#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace vitrum::parallel {

/// Where threads wait for what others bring about: awake for a while, because waking a thread takes long,
/// then asleep. They never yield: on a busy machine that gives away a whole slice of time (some milliseconds)
/// for what may come within a microsecond. Who sleeps keeps its claim on the processor and is back at once.
class Vigil {
 public:
  using Clock = std::chrono::steady_clock;

  /// Returns once done() is true; looks for `awake` at first. done() reads atomics in sequential order.
  template <class Done>
  void wait(std::chrono::microseconds awake, const Done& done) {
    constexpr int looks_at_once = 2000;  // about 1 us
    const Clock::time_point since = Clock::now();
    do {
      for (int i = 0; i < looks_at_once; ++i)
        if (done()) return;
    } while (Clock::now() - since < awake);
    sleep(done);
  }
  template <class Done>
  void sleep(const Done& done) {
    std::unique_lock lock(mutex_);
    ++sleepers_;
    change_.wait(lock, done);
    --sleepers_;
  }
  /// After every change, made in sequential order, that may make a done() true: either this sees who sleeps,
  /// or that one sees the change before it does.
  void changed() {
    if (sleepers_.load() == 0) return;
    { const std::lock_guard lock(mutex_); }
    change_.notify_all();
  }

 private:
  alignas(64) std::atomic<int> sleepers_{0};  // read by all, seldom written
  alignas(64) std::mutex mutex_;
  std::condition_variable change_;
};

}  // namespace vitrum::parallel
