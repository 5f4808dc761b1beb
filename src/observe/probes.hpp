#pragma once
#include <string>
#include <vector>

#include "observe/observer.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// The particles of a body that a probe looks at, by identity, as they stand at the start: one for each
/// point, or all those in a box.
struct Probed {
  std::vector<std::uint32_t> particles;
  double farthest = 0.0;  ///< m, of the points from their particles
};
/// Its body, which the scene's checks have found.
std::size_t body_of(const ProbeDefinition& probe, const System& system);
Probed find_probed(const ProbeDefinition& probe, const Body& body);

/// Fills probes.csv: velocity, stress and elastic strain of material points, and their means over boxes.
class ProbeHistory final : public Observer {
 public:
  static constexpr Column columns[] = {
      {"time", "s", "simulated time"},
      {"probe", "", "name"},
      {"r", "m", "where the particle is now; of a box: centre of mass of its particles"},
      {"z", "m", "(`_r`, `_z` and so on: x, y in plane strain)"},
      {"velocity_r", "m/s", "of the particle; of a box: the mean by mass"},
      {"velocity_z", "m/s", ""},
      {"stress_rr", "Pa", "as the field `stress`; of a box: the mean by volume"},
      {"stress_zz", "Pa", ""},
      {"stress_tt", "Pa", ""},
      {"stress_rz", "Pa", ""},
      {"strain_rr", "1", "elastic strain, tensor shear; of a box: the mean by volume"},
      {"strain_zz", "1", ""},
      {"strain_tt", "1", ""},
      {"strain_rz", "1", ""},
      {"point", "1", "number of the point on its line, from 0"},
      {"particles", "1", "how many the row tells of: sums over a box are its means times these"},
      {"mass", "kg", "of these particles", true}};
  static constexpr TableInfo table_info{
      "probes", "a row for each point of each `[[probe]]` at each time of `output.history_every`", columns};
  static std::unique_ptr<Observer> make(const Scene& scene, const System& system);

  void tell(const System& system) override;
  Table* table() override { return &table_; }

 private:
  /// What one row tells of.
  struct Row {
    std::string probe;
    std::size_t body, point;
    std::vector<std::uint32_t> particles;  ///< identities
  };
  void tell_row(const System& system, const Row& row, const std::vector<std::uint32_t>& place,
                const TensorColumns& stress);

  std::vector<Row> rows_;
  Table table_{table_info};
};

}  // namespace vitrum
