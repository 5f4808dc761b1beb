#include <fmt/format.h>

#include "scene/checks.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

void check_times(const TableView& path, const std::vector<double>& time) {
  if (time.size() < 2) return path.fail("time", path.expected("time"));
  for (std::size_t i = 1; i < time.size(); ++i)
    if (!(time[i] > time[i - 1]))
      return path.report("time", fmt::format("found {} after {} (item {}), expected increasing times",
                                             number_text(time[i]), number_text(time[i - 1]), i));
}

}  // namespace

void check_path(const TableView& document, const PointScene& point) {
  const auto path = document.table("path");
  if (!path) return;
  if (path->sound("time")) check_times(*path, point.time);
  if (!path->sound("time")) return;
  if (path->sound("strain") && point.strain.size() != point.time.size())
    path->fail("strain", fmt::format("{} strains, one for each time", point.time.size()));
  constexpr double most_rows = 1e8;
  const auto segments = static_cast<double>(point.time.size()) - 1.0;
  if (path->sound("samples") && segments * point.samples > most_rows)
    path->report("samples",
                 fmt::format("found {:.3g} rows ({} for each of {} segments), expected at most {:g}",
                             segments * point.samples, point.samples, segments, most_rows));
}

}  // namespace vitrum::scene
