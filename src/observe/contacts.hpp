#pragma once
#include "observe/observer.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Fills contacts.csv: what has passed between each two bodies since the start (mpm/contact keeps it).
class ContactHistories final : public Observer {
 public:
  static constexpr Column columns[] = {
      {"time", "s", "simulated time"},
      {"body_a", "", "name"},
      {"body_b", "", "name"},
      {"impulse_r", "N s",
       "integral of the force on the first since the start; in axisymmetry that of the radial force around "
       "the ring",
       true},
      {"impulse_z", "N s", "the same along the axis (`_r`, `_z`: x, y in plane strain)", true},
      {"friction_work", "J", "dissipated between them since the start", true},
      {"least_gap", "m",
       "least distance of opposite places of their surfaces so far; negative: penetration; inf: none yet"}};
  static constexpr TableInfo table_info{
      "contacts", "a row for each two bodies with contact at each time of `output.history_every`", columns};
  static std::unique_ptr<Observer> make(const Scene& scene, const System& system);

  void tell(const System& system) override;
  Table* table() override { return &table_; }

 private:
  Table table_{table_info};
};

}  // namespace vitrum
