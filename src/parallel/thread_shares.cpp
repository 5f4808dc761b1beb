#include "parallel/thread_shares.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vitrum::parallel {

void ThreadShares::learn(std::span<const double> seconds) {
  if (seconds.size() != work_.size()) return;
  const std::size_t threads = seconds.size();
  // A thread without work tells nothing about its speed: it is taken for as fast as all, to be given some.
  const double all_work = std::accumulate(work_.begin(), work_.end(), 0.0),
               all_seconds = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  if (!(all_work > 0.0 && all_seconds > 0.0 && std::isfinite(all_seconds))) return;
  const double mean = all_work / all_seconds;
  std::vector<double> speed(threads, mean);
  for (std::size_t n = 0; n < threads; ++n)
    if (work_[n] > 0.0 && seconds[n] > 0.0)
      speed[n] = std::clamp(work_[n] / seconds[n], 0.5 * mean, 2.0 * mean);  // (one that was held up, say)
  const double all = std::accumulate(speed.begin(), speed.end(), 0.0);
  // Slowly, because single steps tell little.
  constexpr double weight = 0.1;
  for (std::size_t n = 0; n < threads; ++n) parts_[n] += weight * (speed[n] / all - parts_[n]);
  const double sum = std::accumulate(parts_.begin(), parts_.end(), 0.0);
  for (double& part : parts_) part /= sum;
}

}  // namespace vitrum::parallel
