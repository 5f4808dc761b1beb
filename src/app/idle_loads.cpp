#include "app/idle_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "mpm/computation_error.hpp"
#include "mpm/tractions.hpp"
#include "scene/blast.hpp"
#include "scene/formulas.hpp"
#include "scene/load_functions.hpp"

namespace vitrum::app {
namespace {

void warn_of_pulses(const Scene& scene, Warnings& list) {
  for (std::size_t n = 0; n < scene.tractions.size(); ++n) {
    const auto pulse = pulse_of(scene.tractions[n]);
    if (!pulse) continue;
    const std::string where =
        scene.at(fmt::format("traction.{}.{}", n, scene.tractions[n].blast ? "blast" : "friedlander"));
    const double over = pulse->arrival + pulse->duration;
    if (pulse->arrival >= scene.end)
      list.push_back(fmt::format(
          "{}: the pulse arrives at {:.4g} s, and the run ends at {:.4g} s: nothing of it acts; a "
          "later time.end or an earlier `arrival` lets it",
          where, pulse->arrival, scene.end));
    else if (over <= scene.start)
      list.push_back(
          fmt::format("{}: the pulse is over at {:.4g} s, and the run starts at {:.4g} s: nothing of it acts",
                      where, over, scene.start));
  }
}

/// Places at which a function is asked for: of a traction, the points of its surface.
std::vector<Vector2> places_of(const std::string& path, const System& system) {
  constexpr std::string_view list = "traction.";
  if (!path.starts_with(list)) return {{0.0, 0.0}};
  std::size_t n = 0;
  std::from_chars(path.data() + list.size(), path.data() + path.size(), n);
  std::vector<Vector2> places;
  for (const mpm::LoadedPoint& point : system.tractions->list()[n].points)
    places.push_back({point.place[0], point.place[1]});
  return places;
}

constexpr int tried = 1000;  // equal parts of a run, at whose ends a function is asked for

/// Whether a function is 0 there, and where its slope jumps, at all its places. A table is then 0 all along.
bool rests(const mpm::LoadFunction& function, const Scene& scene, const std::vector<Vector2>& places) {
  std::vector<double> times;
  for (int k = 0; k <= tried; ++k) times.push_back(scene.start + (scene.end - scene.start) * k / tried);
  for (double kink = function.next_kink(scene.start); kink < scene.end; kink = function.next_kink(kink))
    times.push_back(kink);
  try {
    return std::ranges::all_of(times, [&](double time) {
      return std::ranges::all_of(places,
                                 [&](const Vector2& place) { return function.at(time, place) == 0.0; });
    });
  } catch (const ComputationError&) {
    return false;  // the run says so, when it comes to it
  }
}

bool is_over_time(const schema::Function& function) {
  return function.formula.empty() || scene::names_in(function.formula).contains("t");
}

void warn_of_functions(const Scene& scene, const System& system, Warnings& list) {
  constexpr double hardly = 1e-3;
  const double duration = scene.end - scene.start;
  for (const auto& [path, function] : scene.functions) {
    if (!is_over_time(function)) continue;
    if (rests(*load_function(scene, path), scene, places_of(path, system)))
      list.push_back(fmt::format(
          "{}: it is 0 {}from the start of the run, {:.4g} s, to its end, {:.4g} s", scene.at(path),
          function.formula.empty() ? "" : fmt::format("at all of the {} times that were tried ", tried + 1),
          scene.start, scene.end));
    else if (const auto& rows = function.table;
             !rows.empty() && (rows.front()[0] >= scene.end || rows.back()[0] <= scene.start))
      list.push_back(fmt::format(
          "{}: its table is of {:.4g} to {:.4g} s and the run of {:.4g} to {:.4g} s: it stays {:.4g}",
          scene.at(path), rows.front()[0], rows.back()[0], scene.start, scene.end,
          rows.front()[0] >= scene.end ? rows.front()[1] : rows.back()[1]));
    else if (!rows.empty() && duration < hardly * (rows.back()[0] - rows.front()[0]))
      list.push_back(fmt::format(
          "{}: the run takes {:.3g} s, {:.2g} of the {:.3g} s of its table (times are in s)", scene.at(path),
          duration, duration / (rows.back()[0] - rows.front()[0]), rows.back()[0] - rows.front()[0]));
  }
}

}  // namespace

void warn_of_idle_loads(const Scene& scene, const System& system, Warnings& list) {
  warn_of_pulses(scene, list);
  warn_of_functions(scene, system, list);
}

}  // namespace vitrum::app
