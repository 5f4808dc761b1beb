#pragma once
#include "observe/observer.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Fills reactions.csv: what each boundary has given to the bodies since the start.
class ReactionHistory final : public Observer {
 public:
  static constexpr Column columns[] = {
      {"time", "s", "simulated time"},
      {"boundary", "", "name"},
      {"impulse_r", "N s",
       "integral of its force on the bodies since the start; in axisymmetry that of the radial force around "
       "the ring",
       true},
      {"impulse_z", "N s", "the same along the axis (`_r`, `_z`: x, y in plane strain)", true}};
  static constexpr TableInfo table_info{
      "reactions", "a row for each boundary at each time of `output.history_every`", columns};
  static std::unique_ptr<Observer> make(const Scene& scene, const System& system);

  explicit ReactionHistory(const System& system) : impulses_(system.record.impulses.size()) {}

  void step(const System& system, double duration) override;
  void tell(const System& system) override;
  void save(Archive& archive) const override;
  void restore(const Archive& archive) override;
  Table* table() override { return &table_; }

 private:
  std::vector<double> impulses_;  ///< as StepRecord's, since the start
  Table table_{table_info};
};

}  // namespace vitrum
