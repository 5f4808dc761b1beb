#pragma once
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace vitrum::output {

/// What the numbers of two summaries are measured in, and differences between them by. A number that may be
/// next to zero whatever the physics (a momentum across an axis, the place of a centre, an energy that hardly
/// plays a part) is no measure of its own difference.
class QuantityScales {
 public:
  using Json = nlohmann::ordered_json;
  /// duration (s): of what was computed. energy_unit: "J", or "J/m" in plane strain.
  QuantityScales(const std::array<Json, 2>& summaries, double duration, std::string energy_unit);

  /// Of a quantity, by its dotted name.
  std::string unit(const std::string& name) const;
  /// What differences of a quantity are measured by at least, in its unit: of energies the largest of the
  /// account; of momenta and impulses what a body of its mass would have if that were its kinetic energy; of
  /// places how far bodies are from the origin, and how far that energy would move them; of times the
  /// duration; of shares 1. 0: its own magnitude.
  double scale(const std::string& name) const;

 private:
  double momentum_scale(const std::string& name) const;

  double duration_, energy_ = 0.0, length_ = 0.0;
  std::string energy_unit_;
  std::map<std::string, double> momenta_;  ///< by the beginning of names
};

}  // namespace vitrum::output
