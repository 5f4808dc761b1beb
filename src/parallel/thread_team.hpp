#pragma once
#include <pthread.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "parallel/vigil.hpp"

namespace vitrum::parallel {

/// A fixed set of threads that run one loop at a time. Each thread begins with the same share of the chunks
/// in every loop, so that what they stand for stays in its cache, and then helps the others; callers make
/// results independent of who computes which chunk. With one thread no synchronisation happens at all. A team
/// that asks for every processor the process may use gives each thread its own: left to itself, the kernel
/// keeps threads that wait for each other on one processor, for seconds.
class ThreadTeam {
 public:
  /// Throws std::system_error when the system does not give that many threads.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// How long a thread that waits stays awake.
  std::chrono::microseconds patience() const { return patience_; }
  int size() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls body(chunk) for chunk in [0, chunks); returns when all are done. An exception ends the
  /// loop early and reaches the caller (of several, one does).
  template <class Body>
  void for_each_chunk(std::size_t chunks, Body&& body) {
    if (workers_.empty() || chunks < 2) {
      for (std::size_t i = 0; i < chunks; ++i) body(i);
      return;
    }
    share_out(chunks);
    on_each_thread([&](std::size_t thread) { take_chunks(thread, body); });
  }

  /// Calls body(thread) once for every thread, thread 0 being the calling one; returns when all are done.
  /// Each call runs on its thread, or on the calling one where that comes to its end before the other has
  /// begun. An exception reaches the caller (of several, one does).
  template <class Body>
  void on_each_thread(Body&& body) {
    run([](void* context,
           std::size_t thread) { (*static_cast<std::remove_reference_t<Body>*>(context))(thread); },
        &body);
  }

 private:
  using Call = void (*)(void*, std::size_t);
  /// The chunks that one thread begins with.
  struct alignas(64) Share {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };
  /// The last loop in which a thread's part has been taken up.
  struct alignas(64) Claim {
    std::atomic<unsigned> generation{0};
  };
  void share_out(std::size_t chunks);
  template <class Body>
  void take_chunks(std::size_t thread, Body& body) {
    try {
      for (std::size_t i = 0; i < shares_.size(); ++i) {
        Share& share = shares_[(thread + i) % shares_.size()];
        while (share.next.load(std::memory_order_relaxed) < share.end) {
          const std::size_t chunk = share.next.fetch_add(1, std::memory_order_relaxed);
          if (chunk < share.end) body(chunk);
        }
      }
    } catch (...) {
      for (Share& share : shares_) share.next = share.end;
      throw;
    }
  }
  void run(Call call, void* context);
  void call_for(std::size_t thread);
  void work(std::size_t thread);
  bool claim(std::size_t thread, unsigned generation);
  void do_part(std::size_t thread);
  void dismiss();
  void bind_all();

  std::vector<std::thread> workers_;
  std::vector<Share> shares_;  // of the calling thread, then of the workers
  std::vector<Claim> claims_;
  std::chrono::microseconds patience_;
  // What is waited for lies alone: those who look at it all the time delay whoever writes beside it.
  alignas(64) std::atomic<unsigned> generation_{0};
  alignas(64) std::atomic<std::size_t> busy_{0};
  alignas(64) std::atomic<bool> stop_{false};
  Vigil begun_, ended_;
  Call call_ = nullptr;
  void* context_ = nullptr;
  bool bound_ = false;
  cpu_set_t usable_{};  // what the calling thread may use outside of the team's life
  std::mutex of_thrown_;
  std::exception_ptr thrown_;
};

}  // namespace vitrum::parallel
