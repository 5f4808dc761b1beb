#include "app/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "integrators/grid/critical_step.hpp"
#include "mpm/contact/contact.hpp"

namespace vitrum::app {
namespace {

bool rests(const BodyDefinition& body) {
  return body.velocity == Vector2{0.0, 0.0} && body.velocity_gradient == std::array<Vector2, 2>{} &&
         body.stress == std::array<double, 4>{};
}

bool is_driven(const BoundaryDefinition& wall) {
  return wall.velocity != Vector2{0.0, 0.0};
}

double speed_between(const Vector2& a, const Vector2& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

}  // namespace

void warn_of_motion(const Scene& scene, const System& system, Warnings& list) {
  if (scene.functions.empty() && scene.tractions.empty() && scene.gravity == Vector2{0.0, 0.0} &&
      std::ranges::all_of(scene.bodies, rests) && std::ranges::none_of(scene.boundaries, is_driven))
    list.push_back(
        fmt::format("{}: nothing moves in this scene: no body has a velocity or a stress, no boundary a "
                    "velocity, and there is no gravity",
                    scene.at("body")));
  for (std::size_t a = 0; a < scene.bodies.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double speed = speed_between(scene.bodies[a].velocity, scene.bodies[b].velocity);
      const std::size_t slow =
          system.bodies[a].material->wave_speed() < system.bodies[b].material->wave_speed() ? a : b;
      const double wave = system.bodies[slow].material->wave_speed();
      if (!(speed > wave)) continue;
      const auto still = [&](std::size_t n) { return scene.bodies[n].velocity == Vector2{0.0, 0.0}; };
      list.push_back(
          fmt::format("{}: bodies '{}' and '{}' move at {:.4g} m/s to each other, faster than waves in '{}' "
                      "({:.4g} m/s): the laws "
                      "know no shocks",
                      scene.at(fmt::format("body.{}.velocity", still(a) ? b : a)), scene.bodies[b].name,
                      scene.bodies[a].name, speed, scene.bodies[slow].name, wave));
    }
}

void warn_of_travel(const Scene& scene, const System& system, Warnings& list) {
  if (scene.shape_functions != mpm::ShapeKind::linear) return;
  constexpr double few = 3.0;  // cells
  std::string fastest;
  double speed = 0.0;
  const auto consider = [&](const std::string& kind, const std::string& name, double of_it) {
    if (of_it > speed) speed = of_it, fastest = fmt::format("{} '{}'", kind, name);
  };
  for (const Body& body : system.bodies) consider("body", body.name, largest_speed(body.particles));
  for (const BoundaryDefinition& wall : scene.boundaries)
    consider("boundary", wall.name, std::hypot(wall.velocity[0], wall.velocity[1]));
  const double cells = speed * (scene.end - scene.start) / scene.cell;
  if (cells > few)
    list.push_back(fmt::format(
        "{}: {} travels through {:.3g} cells, and linear functions make or lose energy at every crossing; "
        "\"gimp\" and \"bspline2\" do not",
        scene.at("space.shape_functions"), fastest, cells));
}

void warn_of_one_row(const Scene& scene, Warnings& list) {
  if (scene.shape_functions != mpm::ShapeKind::cpgimp) return;
  for (const BodyDefinition& body : scene.bodies)
    if (body.particles_per_cell == 1)
      list.push_back(fmt::format(
          "{}: body '{}' has one particle a cell: drawn by a third it tears, whatever domains its "
          "particles have; with 4 it does not at twice its length",
          scene.at("space.shape_functions"), body.name));
}

void warn_of_scatter(const Scene& scene, const System& system, Warnings& list) {
  constexpr double most_spread = 100.0, most_size = 20.0;
  for (const Body& body : system.bodies) {
    const StrengthScatter* scatter = body.material->scatter();
    if (scatter == nullptr || body.particles.size == 0) continue;
    const std::string material = fmt::format("material.{}.", body.material->parameters().name);
    const auto place = std::ranges::find_if(scene.places, [&](const auto& entry) {
      return entry.first.starts_with(material) && entry.first.ends_with(".scatter");
    });
    const std::string where = scene.at(place != scene.places.end() ? place->first : material);
    // Weibull's quantiles: (-ln(1 - P) volume / V)^(1 / modulus).
    const double spread = std::pow(std::log(0.01) / std::log(0.99), 1.0 / scatter->modulus);
    std::vector<double> masses(body.particles.mass.begin(), body.particles.mass.end());
    const auto middle = masses.begin() + static_cast<std::ptrdiff_t>(masses.size() / 2);
    std::ranges::nth_element(masses, middle);
    const double volume =
        *middle / body.material->density() * (system.axisymmetric ? 2.0 * std::numbers::pi : 1.0);
    const double size = std::pow(std::numbers::ln2 * scatter->volume / volume, 1.0 / scatter->modulus);
    if (spread > most_spread)
      list.push_back(fmt::format(
          "{}: with modulus = {:g} one particle in a hundred of body '{}' bears {:.3g} times what "
          "another one in a hundred does; glass has moduli of 3 to 30",
          where, scatter->modulus, body.name, spread));
    else if (size > most_size || size < 1.0 / most_size)
      list.push_back(fmt::format(
          "{}: half of the particles of body '{}' bear {} than {:.3g} times the law's strength: that is of a "
          "volume of {:.3g} m^3, and a particle has {:.3g} m^3",
          where, body.name, size > 1.0 ? "more" : "less", size, scatter->volume, volume));
  }
}

void warn_of_depth(const System& system, Warnings& list) {
  for (std::size_t n = 0; n < system.contact->pairs().size(); ++n) {
    const mpm::BodyPair& pair = system.contact->pairs()[n];
    if (pair.a == pair.b) continue;  // rubble of one body is always pressed together somewhere
    const double pressed = -system.contact->history()[n].least_gap / pair.law.depth;
    if (pressed > 0.5)
      list.push_back(fmt::format(
          "contact: '{}' and '{}' were pressed by {:.2g} of the depth ({:.3g} m) at which surfaces give way: "
          "from half of it on they bear less, and bodies may pass through each other; try a larger "
          "contact.depth or contact.stiffness",
          system.bodies[pair.a].name, system.bodies[pair.b].name, pressed, pair.law.depth));
  }
}

std::optional<std::string> idle_tolerance(const Scene& scene, const IntegratorCounters& counters) {
  constexpr std::int64_t few = 20;
  constexpr double idle = 0.05;
  if (scene.integrator.method == GridMethod::explicit_steps || scene.integrator.fixed_step ||
      counters.steps < few)
    return std::nullopt;
  const auto steps = static_cast<double>(counters.steps);
  if (static_cast<double>(counters.limited_by_accuracy + counters.rejected) >= idle * steps)
    return std::nullopt;
  struct Limit {
    const char* name;
    std::int64_t steps;
  };
  const Limit limits[] = {{"stability", counters.limited_by_stability},
                          {"contact", counters.limited_by_contact},
                          {"outputs", counters.limited_by_output},
                          {"remaps", counters.limited_by_remap}};
  const Limit& most = *std::ranges::max_element(limits, {}, &Limit::steps);
  return fmt::format(
      "{}: rtol does not act: {:.0f} % of the steps are limited by {}, {:.0f} % by accuracy; {:g} would "
      "give much the same steps",
      scene.at("integrator.rtol"), 100.0 * static_cast<double>(most.steps) / steps, most.name,
      100.0 * static_cast<double>(counters.limited_by_accuracy) / steps, 10.0 * scene.integrator.rtol);
}

}  // namespace vitrum::app
