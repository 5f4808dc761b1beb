#include "app/encounters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "scene/choices.hpp"
#include "scene/shape_gap.hpp"
#include "scene/shapes.hpp"
#include "scene/start_nodes.hpp"

namespace vitrum::app {
namespace {

constexpr double near_in_cells = 4.0;

Box grown(Box box, double by) {
  for (std::size_t k = 0; k < 2; ++k) box.min[k] -= by, box.max[k] += by;
  return box;
}

bool overlap(const Box& a, const Box& b) {
  return a.min[0] <= b.max[0] && b.min[0] <= a.max[0] && a.min[1] <= b.max[1] && b.min[1] <= a.max[1];
}

bool holds(const Box& box, const Vector2& x) {
  return x[0] >= box.min[0] && x[0] <= box.max[0] && x[1] >= box.min[1] && x[1] <= box.max[1];
}

/// Distance of the nearest two particles of two bodies, as long as that is less than `reach`; NaN otherwise.
double particle_gap(const Body& a, const Box& around_a, const Body& b, const Box& around_b, double reach) {
  using Bin = std::array<long long, 2>;
  const auto bin_of = [reach](const Vector2& x) {
    return Bin{static_cast<long long>(std::floor(x[0] / reach)),
               static_cast<long long>(std::floor(x[1] / reach))};
  };
  const auto each_near = [reach](const Body& body, const Box& other, auto&& visit) {
    const Box close = grown(other, reach);
    for (std::size_t i = 0; i < body.particles.size; ++i)
      if (const Vector2 x{body.particles.position[0][i], body.particles.position[1][i]}; holds(close, x))
        visit(x);
  };
  std::map<Bin, std::vector<Vector2>> bins;
  each_near(a, around_b, [&](const Vector2& x) { bins[bin_of(x)].push_back(x); });
  double least = reach;
  each_near(b, around_a, [&](const Vector2& x) {
    const Bin home = bin_of(x);
    for (long long i = -1; i <= 1; ++i)
      for (long long j = -1; j <= 1; ++j)
        if (const auto bin = bins.find({home[0] + i, home[1] + j}); bin != bins.end())
          for (const Vector2& y : bin->second) least = std::min(least, std::hypot(y[0] - x[0], y[1] - x[1]));
  });
  return least < reach ? least : std::numeric_limits<double>::quiet_NaN();
}

std::size_t common_nodes(const Scene& scene, const System& system, std::size_t a, std::size_t b) {
  constexpr double reach = 3.0;  // cells: more than any shape function's
  const Box at_b = grown(bounds(scene.bodies[b]), reach * scene.cell);
  return count_common(nodes_of(system, system.bodies[a], at_b), nodes_of(system, system.bodies[b], at_b));
}

/// Gaps of all pairs: [first][second > first].
std::vector<std::vector<double>> gaps(const Scene& scene) {
  std::vector<std::vector<double>> table(scene.bodies.size());
  for (std::size_t a = 0; a < table.size(); ++a) {
    table[a].assign(table.size(), 0.0);
    for (std::size_t b = a + 1; b < table.size(); ++b) table[a][b] = gap(scene.bodies[a], scene.bodies[b]);
  }
  return table;
}

/// All that a box sweeps over that moves for a while.
Box swept(Box box, const Vector2& velocity, double duration) {
  for (std::size_t k = 0; k < 2; ++k) {
    const double travel = velocity[k] * duration;
    (travel < 0.0 ? box.min[k] : box.max[k]) += travel;
  }
  return box;
}

bool has_gravity(const Scene& scene) {
  return scene.gravity != Vector2{0.0, 0.0} || scene.varies("gravity");
}

/// Whether a body's velocity varies over place, or a boundary's over time.
bool varies(const Scene& scene, const BodyDefinition& body) {
  return scene.varies(fmt::format("body.{}", &body - scene.bodies.data()));
}
bool varies(const Scene& scene, const BoundaryDefinition& wall) {
  return scene.varies(fmt::format("boundary.{}", &wall - scene.boundaries.data()));
}

/// Whether a body only flies: nothing but other bodies and boundaries changes its motion.
bool only_flies(const Scene& scene, const BodyDefinition& body) {
  const bool still = body.velocity == Vector2{0.0, 0.0}, free = !has_gravity(scene);
  const bool rigid =
      body.velocity_gradient == std::array<Vector2, 2>{} && body.stress == std::array<double, 4>{};
  return !still && free && rigid && !varies(scene, body) &&
         std::ranges::find(scene.tractions, body.name, &TractionDefinition::body) == scene.tractions.end() &&
         !(scene.geometry == Geometry::axisymmetric && body.velocity[0] != 0.0);
}

void warn_of_tori(const Scene& scene, Warnings& list) {
  if (scene.geometry != Geometry::axisymmetric) return;
  for (std::size_t n = 0; n < scene.bodies.size(); ++n) {
    const Shape& shape = scene.bodies[n].shape;
    const auto warn = [&](const char* key, double r, const char* meant) {
      if (r > 0.0)
        list.push_back(
            fmt::format("{}: found a centre at r = {:g} m: about the axis it is a torus; centre = [0, ..] "
                        "is {}",
                        scene.at(fmt::format("body.{}.{}", n, key)), r, meant));
    };
    if (const auto* disk = std::get_if<Disk>(&shape)) warn("disk", disk->centre[0], "a sphere");
    if (const auto* ring = std::get_if<Ring>(&shape)) warn("ring", ring->centre[0], "a hollow sphere");
  }
}

constexpr Box anywhere{{-intervals::infinite, -intervals::infinite},
                       {intervals::infinite, intervals::infinite}};

/// What a body or a boundary sweeps over until the end.
Box way_of(const Scene& scene, const BodyDefinition& body) {
  if (varies(scene, body)) return anywhere;
  return swept(bounds(body), body.velocity, scene.end - scene.start);
}
Box way_of(const Scene& scene, const BoundaryDefinition& wall) {
  if (wall.moves && varies(scene, wall)) return anywhere;
  return wall.moves ? swept(wall.box, wall.velocity, scene.end - scene.start) : wall.box;
}

/// Bodies that sweep over no place that another body or a boundary sweeps over, with two cells around.
void warn_of_misses(const Scene& scene, Warnings& list) {
  for (std::size_t n = 0; n < scene.bodies.size(); ++n) {
    const BodyDefinition& body = scene.bodies[n];
    if (!only_flies(scene, body)) continue;
    const Box way = grown(way_of(scene, body), 2.0 * scene.cell);
    bool meets = false;
    for (std::size_t other = 0; other < scene.bodies.size(); ++other)
      meets = meets || (other != n && (scene.bodies[other].velocity_gradient != std::array<Vector2, 2>{} ||
                                       overlap(way, way_of(scene, scene.bodies[other]))));
    for (const BoundaryDefinition& wall : scene.boundaries)
      meets = meets || overlap(way, way_of(scene, wall));
    if (meets) continue;
    list.push_back(fmt::format(
        "{}: body '{}' flies with ({:g}, {:g}) m/s and meets no other body and no boundary before "
        "time.end = {:g} s",
        scene.at(fmt::format("body.{}.velocity", n)), body.name, body.velocity[0], body.velocity[1],
        scene.end));
  }
}

/// Boundaries that no body is at, or comes to as it starts (what it does later, nobody knows: gravity and
/// bodies that stretch or turn are left out).
void warn_of_idle_boundaries(const Scene& scene, Warnings& list) {
  if (has_gravity(scene)) return;
  for (std::size_t n = 0; n < scene.boundaries.size(); ++n) {
    const BoundaryDefinition& wall = scene.boundaries[n];
    const Box way = grown(way_of(scene, wall), 2.0 * scene.cell);
    const bool meets = std::ranges::any_of(scene.bodies, [&](const BodyDefinition& body) {
      return body.velocity_gradient != std::array<Vector2, 2>{} || overlap(way, way_of(scene, body));
    });
    if (!meets)
      list.push_back(fmt::format("{}: boundary '{}' holds no node of a body, and no body heads for it",
                                 scene.at(fmt::format("boundary.{}.box", n)), wall.name));
  }
}

void warn_of_joined(const Scene& scene, const System& system, Warnings& list) {
  const auto table = gaps(scene);
  for (std::size_t a = 0; a < table.size(); ++a)
    for (std::size_t b = a + 1; b < table.size(); ++b) {
      const double between = table[a][b];
      if (!(between > 1e-6 * scene.cell && between < near_in_cells * scene.cell)) continue;
      const std::size_t common = common_nodes(scene, system, a, b);
      if (common == 0) continue;
      list.push_back(fmt::format(
          "{}: bodies '{}' and '{}' are {:.3g} m apart, {:.2g} cells, and share {} node{} of the grid: one "
          "velocity "
          "field joins them from the start; move them apart or use smaller cells",
          scene.at(fmt::format("body.{}.{}", b, scene::shape_names[scene.bodies[b].shape.index()])),
          scene.bodies[a].name, scene.bodies[b].name, between, between / scene.cell, common,
          common == 1 ? "" : "s"));
    }
}

/// Without [contact], bodies that can meet: they would not part again, and nothing in the scene says so. What
/// a body does in a field of forces, nobody knows.
void warn_of_welds(const Scene& scene, Warnings& list) {
  if (scene.contact.stated) return;
  const auto can_meet = [&](const BodyDefinition& a, const BodyDefinition& b) {
    return has_gravity(scene) || a.velocity_gradient != std::array<Vector2, 2>{} ||
           b.velocity_gradient != std::array<Vector2, 2>{} ||
           overlap(grown(way_of(scene, a), 2.0 * scene.cell), way_of(scene, b));
  };
  for (std::size_t b = 1; b < scene.bodies.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (can_meet(scene.bodies[a], scene.bodies[b])) {
        list.push_back(fmt::format(
            "{}: bodies '{}' and '{}' are welded where they meet: without [contact] bodies share one "
            "velocity "
            "field; contact.method = \"bodies\" lets them touch, slide and part, \"single\" says that a weld "
            "is meant",
            scene.at(fmt::format("body.{}", b)), scene.bodies[a].name, scene.bodies[b].name));
        return;
      }
}

}  // namespace

StartGeometry start_geometry(const Scene& scene, const System& system) {
  StartGeometry geometry;
  const std::vector<std::vector<double>> table = gaps(scene);
  const auto between = [&](std::size_t a, std::size_t b) { return table[std::min(a, b)][std::max(a, b)]; };
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < table.size(); ++a) {
    std::size_t nearest = a;
    for (std::size_t b = 0; b < table.size(); ++b) {
      if (b == a) continue;
      if (nearest == a || between(a, b) < between(a, nearest)) nearest = b;
      if (between(a, b) < near_in_cells * scene.cell) pairs.insert(std::minmax(a, b));
    }
    if (nearest != a) pairs.insert(std::minmax(a, nearest));
  }
  const double reach = (near_in_cells + 2.0) * scene.cell;
  for (const auto& [a, b] : pairs)
    geometry.encounters.push_back({a, b, table[a][b],
                                   particle_gap(system.bodies[a], bounds(scene.bodies[a]), system.bodies[b],
                                                bounds(scene.bodies[b]), reach),
                                   common_nodes(scene, system, a, b)});
  for (const BoundaryDefinition& wall : scene.boundaries) {
    std::set<NodeIndex> held;
    for (const Body& body : system.bodies)
      for (const NodeIndex& node : nodes_of(system, body, wall.box)) held.insert(node);
    geometry.boundary_nodes.push_back(held.size());
  }
  return geometry;
}

nlohmann::ordered_json to_json(const StartGeometry& geometry, const Scene& scene) {
  using json = nlohmann::ordered_json;
  json gaps = json::array();
  for (const Encounter& e : geometry.encounters)
    gaps.push_back({{"bodies", {scene.bodies[e.first].name, scene.bodies[e.second].name}},
                    {"gap", e.gap},
                    {"particle_gap", std::isfinite(e.particle_gap) ? json(e.particle_gap) : json(nullptr)},
                    {"common_nodes", e.common_nodes}});
  return {{"gaps", gaps}, {"boundary_nodes", geometry.boundary_nodes}};
}

std::string to_text(const StartGeometry& geometry, const Scene& scene) {
  std::string text;
  for (const Encounter& e : geometry.encounters) {
    text += fmt::format("# bodies '{}' and '{}': {:.6g} m apart", scene.bodies[e.first].name,
                        scene.bodies[e.second].name, e.gap);
    if (std::isfinite(e.particle_gap))
      text += fmt::format(", their nearest particles {:.6g} m", e.particle_gap);
    text += e.common_nodes == 0 ? std::string("; no common node\n")
            : scene.contact.method == ContactMethod::bodies
                ? std::string("; each with a velocity field of its own\n")
                : fmt::format("; joined from the start by {} common nodes\n", e.common_nodes);
  }
  for (std::size_t k = 0; k < geometry.boundary_nodes.size(); ++k)
    text += fmt::format("# boundary '{}': {} nodes with mass\n", scene.boundaries[k].name,
                        geometry.boundary_nodes[k]);
  return text;
}

void warn_of_geometry(const Scene& scene, const System& system, Warnings& list) {
  warn_of_tori(scene, list);
  warn_of_misses(scene, list);
  warn_of_idle_boundaries(scene, list);
  if (scene.contact.method == ContactMethod::single) warn_of_joined(scene, system, list);
  warn_of_welds(scene, list);
}

}  // namespace vitrum::app
