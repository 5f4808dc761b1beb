#pragma once
#include "observe/observer.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// How a body moves as a whole, without particles that have left (axisymmetric: the whole body; plane strain:
/// per metre).
struct BodyMotion {
  double mass = 0.0;                 ///< kg
  std::array<double, 2> momentum{};  ///< kg m/s, summed over particles: the radial one is that of no vector
  std::array<double, 2> centre{};    ///< m, of mass
  double kinetic = 0.0;              ///< J
};
BodyMotion motion_of(const Body& body, double whole);

/// Fills bodies.csv: the motion, energy and failure of each body.
class BodyHistory final : public Observer {
 public:
  static constexpr Column columns[] = {
      {"time", "s", "simulated time"},
      {"body", "", "name"},
      {"momentum_r", "kg m/s", "sum over particles; in axisymmetry that of the radial components", true},
      {"momentum_z", "kg m/s", "sum over particles (`_r`, `_z`: x, y in plane strain)", true},
      {"centre_r", "m",
       "centre of mass (in axisymmetry of the section, each particle with the mass of its ring)"},
      {"centre_z", "m", "centre of mass"},
      {"kinetic", "J", "kinetic energy of its particles", true},
      {"elastic", "J", "stored elastic energy", true},
      {"localised", "1", "localised particles"},
      {"separated", "1", "separated particles"},
      {"fragments", "1", "connected pieces; 1 as long as nothing has separated"},
      {"largest_fragment", "kg", "mass of the largest piece", true},
      {"crack_area", "m^2", "area of cracks, localised or separated: sum of V0/L_e", true},
      {"localised_volume", "m^3", "volume of the localised particles", true}};
  static constexpr TableInfo table_info{
      "bodies", "a row for each body at each time of `output.history_every`", columns};
  static std::unique_ptr<Observer> make(const Scene& scene, const System& system);

  void tell(const System& system) override;
  Table* table() override { return &table_; }

 private:
  Table table_{table_info};
};

}  // namespace vitrum
