#include "app/magnitudes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/blast.hpp"
#include "scene/shape_measures.hpp"

namespace vitrum::app {
namespace {

void warn_of_cell(const Scene& scene, Warnings& list) {
  for (const BodyDefinition& body : scene.bodies) {
    const double width = measures(body, scene.geometry).width;
    if (width < (1.0 - 1e-6) * scene.cell)
      list.push_back(
          fmt::format("{}: body '{}' is {:.3g} m wide, less than a cell ({:.3g} m): the grid does not "
                      "see it deform",
                      scene.at("space.cell"), body.name, width, scene.cell));
  }
}

void warn_of_outputs(const Scene& scene, const System& system, const Work& work, Warnings& list) {
  constexpr double minutes = 600.0, times = 10.0, never = 100.0;
  const double duration = scene.end - scene.start, seconds = output_seconds(scene, system);
  if (scene.output.every && seconds > std::max(minutes, times * work.seconds))
    list.push_back(
        fmt::format("{}: {:.3g} outputs take about {} and {} of disk space; computing takes about {}",
                    scene.at("output.every"), duration / *scene.output.every, duration_text(seconds),
                    bytes_text(disk_space_of(scene, system, true)), duration_text(work.seconds)));
  const auto warn_of_interval = [&](const char* key, const std::optional<double>& every, const char* left) {
    if (every && *every > never * duration)
      list.push_back(fmt::format("{}: {:g} s is longer than the run ({:g} s): {}", scene.at(key), *every,
                                 duration, left));
  };
  warn_of_interval("output.every", scene.output.every, "only the last state is written");
  warn_of_interval("output.history_every", scene.output.history_every,
                   "tables have their first and last row");
  warn_of_interval("output.checkpoint_every", scene.output.checkpoint_every, "no checkpoint is planned");
}

/// Stresses beyond what laws of small elastic strains are for.
void warn_of_stresses(const Scene& scene, Warnings& list) {
  constexpr double largest_strain = 0.1;
  const auto consider = [&](const std::string& key, std::size_t body, double stress) {
    const double young = scene.material_of(body).elastic.young;
    if (std::abs(stress) > largest_strain * young)
      list.push_back(
          fmt::format("{}: {:.3g} Pa is more than a tenth of the modulus of body '{}' ({:.3g} Pa): its "
                      "laws are for small elastic strains",
                      scene.at(key), stress, scene.bodies[body].name, young));
  };
  const auto largest = [](const auto& components) {
    return *std::ranges::max_element(components, {}, [](double s) { return std::abs(s); });
  };
  for (std::size_t n = 0; n < scene.bodies.size(); ++n)
    consider(fmt::format("body.{}.stress", n), n, largest(scene.bodies[n].stress));
  for (std::size_t n = 0; n < scene.tractions.size(); ++n) {
    const TractionDefinition& traction = scene.tractions[n];
    const std::string path = fmt::format("traction.{}.", n);
    const auto body = static_cast<std::size_t>(
        std::ranges::find(scene.bodies, traction.body, &BodyDefinition::name) - scene.bodies.begin());
    if (traction.pressure) consider(path + "pressure", body, *traction.pressure);
    if (traction.vector) consider(path + "vector", body, largest(*traction.vector));
    if (const auto pulse = pulse_of(traction))
      consider(path + (traction.blast ? "blast" : "friedlander"), body, pulse->pressure);
  }
}

}  // namespace

void warn_of_magnitudes(const Scene& scene, const System& system, const Work& work, Warnings& list) {
  warn_of_cell(scene, list);
  warn_of_outputs(scene, system, work, list);
  warn_of_stresses(scene, list);
}

}  // namespace vitrum::app
