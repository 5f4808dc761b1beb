#include "mpm/thread_shares.hpp"

#include <algorithm>
#include <numeric>

namespace vitrum::mpm {

void ThreadShares::learn(std::span<const double> seconds) {
  if (seconds.size() != work_.size()) return;
  const auto threads = static_cast<double>(seconds.size());
  // A thread without work tells nothing about its speed; it will only once it has some.
  bool tell = true;
  for (std::size_t n = 0; n < work_.size(); ++n) tell = tell && work_[n] > 0.0 && seconds[n] > 0.0;
  std::vector<double> speed(seconds.size(), 1.0);
  for (std::size_t n = 0; tell && n < speed.size(); ++n) speed[n] = work_[n] / seconds[n];
  const double all = std::accumulate(speed.begin(), speed.end(), 0.0);
  // Slowly, because single steps tell little; and every thread keeps some work, to be measured by.
  constexpr double weight = 0.1, least = 0.25;
  for (std::size_t n = 0; n < speed.size(); ++n)
    parts_[n] = std::max(least / threads, parts_[n] + weight * (speed[n] / all - parts_[n]));
  const double sum = std::accumulate(parts_.begin(), parts_.end(), 0.0);
  for (double& part : parts_) part /= sum;
}

}  // namespace vitrum::mpm
