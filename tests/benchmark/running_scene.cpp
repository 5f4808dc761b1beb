#include "benchmark/running_scene.hpp"

#include <fmt/format.h>

#include <map>

namespace vitrum::benchmarks {

Scene bar(long thousands, std::vector<std::string> overrides) {
  // 4 particles a cell over 5 mm x 25 mm; the step is 0.2 cells of the wave speed, as in the file.
  const std::map<long, double> cells{
      {1, 0.625e-3}, {5, 0.3125e-3}, {20, 0.15625e-3}, {80, 0.078125e-3}, {500, 0.03125e-3}};
  const double cell = cells.at(thousands);
  overrides.push_back(fmt::format("space.cell={:.17g}", cell));
  overrides.push_back(fmt::format("integrator.step={:.17g}", 3.095e-9 * cell / 0.078125e-3));
  overrides.push_back("time.end=1.0");
  return study("performance/elastic_bar.toml", overrides);
}

Scene disks(long thousands, std::vector<std::string> overrides) {
  const std::map<long, double> per_metre{{1, 36.0}, {20, 141.0}, {80, 282.0}, {500, 705.0}};
  const double cell = 1.0 / per_metre.at(thousands);
  overrides.push_back(fmt::format("space.cell={:.17g}", cell));
  overrides.push_back(fmt::format("integrator.step={:.17g}", 0.2 * cell));  // the wave speed is 1 m/s
  return study("performance/colliding_disks.toml", overrides);
}

Scene reference_case(std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), {"integrator.scheme=\"musl\"", "integrator.step=5e-8"});
  return study("paper/reference.toml", overrides);
}

}  // namespace vitrum::benchmarks
