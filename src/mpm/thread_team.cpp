#include "mpm/thread_team.hpp"

namespace vitrum::mpm {

ThreadTeam::ThreadTeam(int threads) {
  for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
}

ThreadTeam::~ThreadTeam() {
  stop_ = true;
  ++generation_;
  generation_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadTeam::take_chunks() {
  for (std::size_t i = next_.fetch_add(1); i < chunks_; i = next_.fetch_add(1)) call_(context_, i);
}

void ThreadTeam::work() {
  unsigned seen = 0;
  while (true) {
    generation_.wait(seen);
    seen = generation_.load();
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
  for (std::size_t left = busy_.load(); left != 0; left = busy_.load()) busy_.wait(left);
}

}  // namespace vitrum::mpm
