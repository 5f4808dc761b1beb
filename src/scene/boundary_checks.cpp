#include "scene/boundary_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/boundary.hpp"
#include "scene/choices.hpp"
#include "scene/toml_text.hpp"

namespace vitrum {
namespace {

struct Times {
  double first, last;
};

/// Lets `times` be those of them at which lowest <= speed t <= highest.
void restrict_to(Times& times, double speed, double lowest, double highest) {
  if (speed == 0.0) {
    if (!(lowest <= 0.0 && 0.0 <= highest)) times.last = -1.0;
    return;
  }
  const double a = lowest / speed, b = highest / speed;
  times.first = std::max(times.first, std::min(a, b));
  times.last = std::min(times.last, std::max(a, b));
}

const schema::Function* velocity_over_time(const Scene& scene, const BoundaryDefinition& boundary,
                                           std::size_t component) {
  return scene.function(
      fmt::format("boundary.{}.velocity.{}", &boundary - scene.boundaries.data(), component));
}

/// Cells per second.
double speed(const Scene& scene, const BoundaryDefinition& boundary, std::size_t component) {
  return boundary.moves ? boundary.velocity[component] / scene.cell : 0.0;
}

/// "y = 0.01", of a row of nodes.
std::string place_of_row(const Scene& scene, std::size_t component, double row) {
  return fmt::format("{} = {:.6g}", scene::component_names(scene.geometry)[component], row * scene.cell);
}

/// Says that no row of nodes lies in the box along a component's axis, and which one is nearest.
std::string describe_gap(const Scene& scene, const Box& box, std::size_t component) {
  const double min = box.min[component] / scene.cell, max = box.max[component] / scene.cell;
  const double below = std::floor(min), above = std::ceil(max);
  return fmt::format("no row of nodes lies between {} and {:.6g} m; the nearest is at {} m",
                     place_of_row(scene, component, min), box.max[component],
                     place_of_row(scene, component, min - below <= above - max ? below : above));
}

}  // namespace

std::optional<double> contradiction(const Scene& scene, const BoundaryDefinition& a,
                                    const BoundaryDefinition& b) {
  bool differ = false, vary = false;
  for (std::size_t c = 0; c < 2; ++c) {
    const schema::Function *of_a = velocity_over_time(scene, a, c), *of_b = velocity_over_time(scene, b, c);
    const bool same = of_a != nullptr && of_b != nullptr
                          ? !of_a->formula.empty() && of_a->formula == of_b->formula
                          : of_a == of_b && a.velocity[c] == b.velocity[c];
    differ = differ || (a.fixed[c] && b.fixed[c] && !same);
    vary = vary || of_a != nullptr || of_b != nullptr;
  }
  if (!differ || a.priority != b.priority) return std::nullopt;
  Times times{0.0, scene.end - scene.start};
  for (std::size_t c = 0; c < 2; ++c) {
    const mpm::Rows of_a = mpm::rows_between(a.box.min[c], a.box.max[c], scene.cell),
                    of_b = mpm::rows_between(b.box.min[c], b.box.max[c], scene.cell);
    if (!of_a.any() || !of_b.any()) return std::nullopt;
    // Where velocities vary only the start is looked at here; that boxes meet later is found as they do.
    const double relative = vary ? 0.0 : speed(scene, a, c) - speed(scene, b, c);
    // A box holds the nodes that are nearest to it: it comes to them half a cell before it is there.
    const double early = relative != 0.0 ? 0.5 : 0.0;
    restrict_to(times, relative, of_b.first - of_a.last - early, of_b.last - of_a.first + early);
  }
  if (!(times.first <= times.last)) return std::nullopt;
  return scene.start + times.first;
}

std::vector<std::string> boundary_warnings(const Scene& scene) {
  std::vector<std::string> list;
  for (std::size_t n = 0; n < scene.boundaries.size(); ++n) {
    const Box& box = scene.boundaries[n].box;
    for (std::size_t c = 0; c < 2; ++c)
      if (!mpm::rows_between(box.min[c], box.max[c], scene.cell).any())
        list.push_back(fmt::format("{}: boundary '{}' holds no node: {}",
                                   scene.at(fmt::format("boundary.{}.box", n)), scene.boundaries[n].name,
                                   describe_gap(scene, box, c)));
  }
  return list;
}

}  // namespace vitrum
