#pragma once
#include <cstdint>
#include <optional>

#include "scene/scene.hpp"

namespace vitrum::app {

/// The times at which a run stops stepping to write something: multiples of the interval, never accumulated
/// (so that t = 0, where a scene may put first touch, is one of them whatever the start), and the end.
class Schedule {
 public:
  Schedule(const Scene& scene);

  /// What to do at a target.
  struct Target {
    double time;  ///< s
    bool output, checkpoint;
  };
  /// The next target after `done` outputs (the one at the start, if any, not counted) and `checkpoints`; the
  /// last is the end.
  Target next(std::int64_t outputs, std::int64_t checkpoints) const;
  /// Whether the state at the start is an output: where outputs are periodic.
  bool output_at_start() const { return every_.has_value(); }

  /// Rows of energy.csv are written at the first step at or after these times.
  double energy_row(std::int64_t row) const {
    return start_ + (end_ - start_) * static_cast<double>(row) / energy_rows;
  }
  static constexpr double energy_rows = 1000.0;

 private:
  double start_, end_;
  std::optional<double> every_, checkpoint_every_;
};

}  // namespace vitrum::app
