#include "parallel/thread_team.hpp"

#include <utility>

namespace vitrum::parallel {
namespace {

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
    : shares_(static_cast<std::size_t>(threads)),
      claims_(shares_.size()),
      patience_(patience_of(shares_.size())) {
  try {
    for (std::size_t i = 1; i < shares_.size(); ++i) workers_.emplace_back([this, i] { work(i); });
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
  begun_.changed();
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

/// Whether the part of a thread in the loop of this generation is still to be done: it is the asker's then.
bool ThreadTeam::claim(std::size_t thread, unsigned generation) {
  unsigned last = generation - 1;
  return claims_[thread].generation.compare_exchange_strong(last, generation);
}

void ThreadTeam::do_part(std::size_t thread) {
  call_for(thread);
  if (--busy_ == 0) ended_.changed();
}

void ThreadTeam::work(std::size_t thread) {
  for (unsigned seen = 0; true;) {
    begun_.wait(patience_, [&] { return generation_ != seen; });
    seen = generation_;
    if (stop_) return;
    if (claim(thread, seen)) do_part(thread);
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
  const unsigned generation = ++generation_;
  begun_.changed();
  call_for(0);
  // Who has not come yet may have lost the processor to another process, for longer than all of this takes.
  for (std::size_t thread = 1; thread < shares_.size(); ++thread)
    if (claim(thread, generation)) do_part(thread);
  ended_.wait(patience_, [&] { return busy_ == 0; });
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

}  // namespace vitrum::parallel
