#include "app/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace vitrum::app {

Schedule::Schedule(const Scene& scene)
    : start_(scene.start),
      end_(scene.end),
      every_(scene.output.every),
      checkpoint_every_(scene.output.checkpoint_every) {}

Schedule::Target Schedule::next(std::int64_t outputs, std::int64_t checkpoints) const {
  // Times closer than this are one: what rounding makes of the same time.
  const double slack = 1e-9 * (end_ - start_);
  const auto planned = [&](const std::optional<double>& every, std::int64_t done) {
    if (!every) return end_;
    const double first = std::floor((start_ + slack) / *every) + 1.0;  // the first multiple after the start
    const double t = (first + static_cast<double>(done)) * *every;
    return t > end_ - slack ? end_ : t;
  };
  const double output = planned(every_, outputs), checkpoint = planned(checkpoint_every_, checkpoints);
  const double time = std::min(output, checkpoint);
  const bool writes_output = output <= time + slack;
  return {writes_output ? output : time, writes_output,
          checkpoint_every_.has_value() && checkpoint <= time + slack};
}

}  // namespace vitrum::app
