#include "mpm/thread_team.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "mpm/computation_error.hpp"

namespace vitrum::mpm {
namespace {

/// Waits until `value` is no longer `old`. First awake, for about as long as a pass over a small scene takes:
/// the kernel needs longer than that to wake a thread.
template <class T>
T wait_for_change(const std::atomic<T>& value, T old) {
  constexpr int looks = 20000;  // about 10 us
  for (int i = 0; i < looks; ++i)
    if (const T now = value.load(std::memory_order_acquire); now != old) return now;
  value.wait(old);
  return value.load();
}

}  // namespace

ThreadTeam::ThreadTeam(int threads) {
  try {
    for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
  } catch (const std::system_error& error) {
    dismiss();
    throw ComputationError(fmt::format("{} threads cannot be started: {}; ask for fewer (--threads)", threads,
                                       error.code().message()));
  } catch (...) {
    dismiss();
    throw;
  }
}

ThreadTeam::~ThreadTeam() {
  dismiss();
}

void ThreadTeam::dismiss() {
  stop_ = true;
  ++generation_;
  generation_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadTeam::take_chunks() {
  try {
    for (std::size_t i = next_.fetch_add(1); i < chunks_; i = next_.fetch_add(1)) call_(context_, i);
  } catch (...) {
    next_ = chunks_;
    const std::lock_guard lock(of_thrown_);
    thrown_ = std::current_exception();
  }
}

void ThreadTeam::work() {
  unsigned seen = 0;
  while (true) {
    seen = wait_for_change(generation_, seen);
    if (stop_) return;
    take_chunks();
    if (busy_.fetch_sub(1) == 1) busy_.notify_all();
  }
}

void ThreadTeam::run(std::size_t chunks, Call call, void* context) {
  chunks_ = chunks;
  call_ = call;
  context_ = context;
  next_ = 0;
  busy_ = workers_.size();
  ++generation_;
  generation_.notify_all();
  take_chunks();
  for (std::size_t left = busy_.load(); left != 0;) left = wait_for_change(busy_, left);
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

}  // namespace vitrum::mpm
