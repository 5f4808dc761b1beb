#pragma once
#include "observe/observer.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Fills removed.csv: every particle that has left the computation, as it was then. With these rows nothing
/// is lost: mass, momentum and kinetic energy of what has gone are sums over them.
class RemovedParticles final : public Observer {
 public:
  static constexpr Column columns[] = {
      {"time", "s", "end of the step (of the phase in `arkode-implicit`) in which it separated"},
      {"body", "", "name"},
      {"particle", "1", "number of the particle in its body, from 0"},
      {"r", "m", "where it left; fields keep it there, at rest"},
      {"z", "m", "(`r`, `z`: x, y in plane strain)"},
      {"velocity_r", "m/s", "with which it left"},
      {"velocity_z", "m/s", "(`_r`, `_z`: x, y in plane strain)"},
      {"mass", "kg", "", true}};
  static constexpr TableInfo table_info{
      "removed",
      "every particle that has left the computation, in order of time, body and particle; only where "
      "`decohesion.separated` is `removed`",
      columns};
  static std::unique_ptr<Observer> make(const Scene& scene, const System& system);

  RemovedParticles();
  void step(const System& system, double duration) override;
  Table* table() override { return &table_; }

 private:
  Table table_{table_info};
};

}  // namespace vitrum
