#include "app/magnitudes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/blast.hpp"
#include "scene/shape_measures.hpp"
#include "scene/shapes.hpp"

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

/// A duration in which a wave passes through the bodies more often than explicit steps could tell anything
/// of, or in which something flies farther than there is a scene to fly through.
void warn_of_end(const Scene& scene, const System& system, Warnings& list) {
  constexpr double most_passages = 1e5, most_widths = 1e3, micro = 1e-6;
  const double duration = scene.end - scene.start;
  double across = 0.0, wave = 0.0, speed = 0.0;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const Box box = bounds(scene.bodies[n]);
    across = std::max({across, box.max[0] - box.min[0], box.max[1] - box.min[1]});
    wave = std::max(wave, system.bodies[n].material->wave_speed());
    speed = std::max(speed, largest_speed(system.bodies[n].particles));
  }
  for (const BoundaryDefinition& wall : scene.boundaries)
    speed = std::max(speed, std::hypot(wall.velocity[0], wall.velocity[1]));
  const double passages = duration * wave / across, widths = duration * speed / across;
  const bool many = scene.integrator.method != GridMethod::arkode_implicit && passages > most_passages;
  if (!many && !(widths > most_widths)) return;
  list.push_back(fmt::format(
      "{}: in {:g} s {}; end = {:g}: {}", scene.at("time.end"), duration,
      many ? fmt::format("a wave passes {:.2g} times through the largest body ({:.3g} m)", passages, across)
           : fmt::format("what moves at {:.3g} m/s goes {:.3g} m, and the largest body has {:.3g} m", speed,
                         speed * duration, across),
      scene.end,
      passages * micro > 0.01 ? fmt::format("did you mean {:g}e-6?", scene.end) : "is it in seconds?"));
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
  warn_of_end(scene, system, list);
  warn_of_outputs(scene, system, work, list);
  warn_of_stresses(scene, list);
}

}  // namespace vitrum::app
