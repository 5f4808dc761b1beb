#pragma once
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace vitrum::mpm {

/// A fixed set of threads that run one loop at a time. Chunks are handed out dynamically; callers make
/// results independent of who computes which chunk. With one thread no synchronisation happens at all.
class ThreadTeam {
 public:
  /// Throws ComputationError when the system does not give that many threads.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls body(chunk) for chunk in [0, chunks); returns when all are done. An exception ends the
  /// loop early and reaches the caller (of several, one does).
  template <class Body>
  void for_each_chunk(std::size_t chunks, Body&& body) {
    if (workers_.empty() || chunks < 2) {
      for (std::size_t i = 0; i < chunks; ++i) body(i);
      return;
    }
    run(
        chunks,
        [](void* context, std::size_t i) { (*static_cast<std::remove_reference_t<Body>*>(context))(i); },
        &body);
  }

 private:
  using Call = void (*)(void*, std::size_t);
  void run(std::size_t chunks, Call call, void* context);
  void work();
  void take_chunks();
  void dismiss();

  std::vector<std::thread> workers_;
  std::atomic<std::size_t> next_{0};
  std::atomic<unsigned> generation_{0};
  std::atomic<std::size_t> busy_{0};
  std::atomic<bool> stop_{false};
  std::size_t chunks_ = 0;
  Call call_ = nullptr;
  void* context_ = nullptr;
  std::mutex of_thrown_;
  std::exception_ptr thrown_;
};

}  // namespace vitrum::mpm
