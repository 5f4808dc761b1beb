#include <fmt/format.h>

#include "scene/scene_keys.hpp"
#include "scene/sections.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

bool check_times(const TableReader& path, const std::vector<double>& time) {
  if (time.size() < 2) {
    path.fail("time", find_key(keys::path(), "time").expected);
    return false;
  }
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (time[i] > time[i - 1]) continue;
    path.report("time", fmt::format("found {} after {} (item {}), expected increasing times",
                                    number_text(time[i]), number_text(time[i - 1]), i));
    return false;
  }
  return true;
}

}  // namespace

void read_path(const TableReader& document, PointScene& point) {
  const auto path = document.table("path", keys::path());
  if (!path) return;
  const bool has_time = path->read("time", point.time) && check_times(*path, point.time);
  std::vector<std::vector<double>> rows;
  if (path->read_rows("strain", 4, rows)) {
    for (const std::vector<double>& row : rows) point.strain.push_back({row[0], row[1], row[2], row[3]});
    if (has_time && point.strain.size() != point.time.size())
      path->fail("strain", fmt::format("{} strains, one for each time", point.time.size()));
  }
  path->read("size", point.size);
  constexpr double most_rows = 1e8;
  const auto segments = static_cast<double>(point.time.size()) - 1.0;
  if (path->read("samples", point.samples) || has_time)
    if (segments * point.samples > most_rows)
      path->report("samples",
                   fmt::format("found {:.3g} rows ({} for each of {} segments), expected at most {:g}",
                               segments * point.samples, point.samples, segments, most_rows));
}

}  // namespace vitrum::scene
