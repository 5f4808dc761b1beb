#include "mpm/thread_team.hpp"

#include <fmt/format.h>

#include <chrono>
#include <system_error>
#include <utility>

#include "mpm/computation_error.hpp"

namespace vitrum::mpm {
namespace {

using Clock = std::chrono::steady_clock;

/// Waits until `value` is no longer `old`, the first so many microseconds awake. After every 30 of them gives
/// way to whoever else wants the processor.
template <class T>
T wait_for_change(const std::atomic<T>& value, T old, std::chrono::microseconds awake) {
  constexpr int looks_at_once = 2000;  // about 1 us
  constexpr std::chrono::microseconds at_once(30);
  const Clock::time_point since = Clock::now();
  for (Clock::time_point now = since, gave_way = since; now - since < awake; now = Clock::now()) {
    for (int i = 0; i < looks_at_once; ++i)
      if (const T seen = value.load(std::memory_order_acquire); seen != old) return seen;
    if (now - gave_way < at_once) continue;
    std::this_thread::yield();
    gave_way = now;
  }
  value.wait(old);
  return value.load();
}

/// How long a thread of a team of this size waits awake. On a virtual machine, waking a thread that sleeps
/// was seen to cost 30 us who wakes it, and 230 us until it is awake, longer than most of what a thread does
/// alone between two loops. Where threads are more than processors, those who wait are in the way of those
/// who work.
std::chrono::microseconds patience_of(std::size_t threads) {
  cpu_set_t usable;
  const bool known = pthread_getaffinity_np(pthread_self(), sizeof usable, &usable) == 0;
  const bool crowded = known && static_cast<std::size_t>(CPU_COUNT(&usable)) < threads;
  return std::chrono::microseconds(crowded ? 10 : 300);
}

/// Lets a thread run on these processors only. A refusal costs time, nothing else.
void bind(pthread_t thread, const cpu_set_t& processors) {
  pthread_setaffinity_np(thread, sizeof processors, &processors);
}

}  // namespace

ThreadTeam::ThreadTeam(int threads)
    : shares_(static_cast<std::size_t>(threads)), patience_(patience_of(shares_.size())) {
  try {
    for (std::size_t i = 1; i < shares_.size(); ++i) workers_.emplace_back([this, i] { work(i); });
  } catch (const std::system_error& error) {
    dismiss();
    throw ComputationError(fmt::format("{} threads cannot be started: {}; ask for fewer (--threads)", threads,
                                       error.code().message()));
  } catch (...) {
    dismiss();
    throw;
  }
  if (threads > 1) bind_all();
}

/// Gives each thread its own processor if they need all that this process may use.
void ThreadTeam::bind_all() {
  if (pthread_getaffinity_np(pthread_self(), sizeof usable_, &usable_) != 0) return;
  if (CPU_COUNT(&usable_) != size()) return;
  bound_ = true;
  std::size_t thread = 0;
  for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
    if (!CPU_ISSET(processor, &usable_)) continue;
    cpu_set_t own;
    CPU_ZERO(&own);
    CPU_SET(processor, &own);
    bind(thread == 0 ? pthread_self() : workers_[thread - 1].native_handle(), own);
    ++thread;
  }
}

ThreadTeam::~ThreadTeam() {
  dismiss();
  if (bound_) bind(pthread_self(), usable_);
}

void ThreadTeam::dismiss() {
  stop_ = true;
  ++generation_;
  generation_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadTeam::call_for(std::size_t thread) {
  try {
    call_(context_, thread);
  } catch (...) {
    const std::lock_guard lock(of_thrown_);
    thrown_ = std::current_exception();
  }
}

void ThreadTeam::work(std::size_t thread) {
  unsigned seen = 0;
  while (true) {
    seen = wait_for_change(generation_, seen, patience_);
    if (stop_) return;
    call_for(thread);
    if (busy_.fetch_sub(1) == 1) busy_.notify_all();
  }
}

void ThreadTeam::share_out(std::size_t chunks) {
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    shares_[i].next = chunks * i / shares_.size();
    shares_[i].end = chunks * (i + 1) / shares_.size();
  }
}

void ThreadTeam::run(Call call, void* context) {
  if (workers_.empty()) return call(context, 0);
  call_ = call;
  context_ = context;
  busy_ = workers_.size();
  ++generation_;
  generation_.notify_all();
  call_for(0);
  for (std::size_t left = busy_.load(); left != 0;) left = wait_for_change(busy_, left, patience_);
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

}  // namespace vitrum::mpm
