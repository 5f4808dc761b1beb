#include "scene/build_tractions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/tractions.hpp"
#include "scene/blast.hpp"
#include "scene/input_error.hpp"
#include "scene/load_functions.hpp"
#include "scene/nearest_particle.hpp"
#include "scene/surface_edges.hpp"

namespace vitrum {
namespace {

/// Gauss' rule of six points on [0, 1]: exact on straight edges for what is of degree 11 along them, on arcs
/// as long as a particle to rounding.
constexpr std::array<std::array<double, 2>, 6> rule{{{0.03376524289842397, 0.08566224618958517},
                                                     {0.16939530676686776, 0.18038078652406930},
                                                     {0.38069040695840156, 0.23395696728634552},
                                                     {0.61930959304159844, 0.23395696728634552},
                                                     {0.83060469323313224, 0.18038078652406930},
                                                     {0.96623475710157603, 0.08566224618958517}}};

bool is_inside(const Box& box, const Vector2& x, double slack) {
  bool inside = true;
  for (std::size_t c = 0; c < 2; ++c)
    inside = inside && x[c] >= box.min[c] - slack && x[c] <= box.max[c] + slack;
  return inside;
}

/// Where an edge is cut: into pieces of about a spacing, and where what is loaded ends.
std::vector<double> cuts(const Edge& edge, const TractionDefinition& loaded, double spacing) {
  std::vector<double> list;
  const int count = edge.pieces(spacing);
  for (int k = 0; k <= count; ++k) list.push_back(static_cast<double>(k) / count);
  const auto add = [&list](const std::vector<double>& places) {
    for (const double s : places)
      if (s > 0.0 && s < 1.0) list.push_back(s);
  };
  for (std::size_t c = 0; c < 2 && loaded.box; ++c)
    for (const double side : {loaded.box->min[c], loaded.box->max[c]}) add(edge.crossings(c, side));
  if (loaded.side) add(edge.corners());
  std::sort(list.begin(), list.end());
  return list;
}

/// Whether the place of an edge is on a side. Normals halfway between two sides are those of top and bottom.
bool is_on(const Edge& edge, double s, Side side) {
  if (side == Side::inner || side == Side::outer) return edge.inner() == (side == Side::inner);
  constexpr double halfway = 1e-9;
  const double normal = edge.normal(s), x = std::cos(normal), y = std::sin(normal);
  const bool upright = std::abs(y) >= std::abs(x) - halfway;
  if (side == Side::top || side == Side::bottom) return upright && (y > 0.0) == (side == Side::top);
  return !upright && (x > 0.0) == (side == Side::right);
}

std::vector<mpm::LoadedPoint> loaded_points(const TractionDefinition& loaded, const Region& region,
                                            bool axisymmetric, const Body& body) {
  const double spacing = 2.0 * body.particle_half_size;
  const NearestParticle nearest(body.particles, spacing);
  const auto& x = body.particles.position;
  std::vector<mpm::LoadedPoint> points;
  for (const Edge& edge : edges_of(region, axisymmetric)) {
    const std::vector<double> at = cuts(edge, loaded, spacing);
    for (std::size_t k = 1; k < at.size(); ++k) {
      const double from = at[k - 1], part = at[k] - from;
      const Vector2 middle = edge.place(from + 0.5 * part);
      if (!(part > 0.0) || (loaded.box && !is_inside(*loaded.box, middle, 1e-9 * spacing))) continue;
      if (loaded.side && !is_on(edge, from + 0.5 * part, *loaded.side)) continue;
      if (axisymmetric && !(middle[0] > 1e-9 * spacing)) continue;
      const std::uint32_t carrier = nearest.to(middle);
      for (const auto& [node, weight] : rule) {
        const double s = from + node * part;
        const Vector2 place = edge.place(s);
        points.push_back({body.particles.identity[carrier],
                          {place[0] - x[0][carrier], place[1] - x[1][carrier]},
                          place,
                          edge.normal(s),
                          weight * part * edge.length() * (axisymmetric ? place[0] : 1.0)});
      }
    }
  }
  return points;
}

}  // namespace

void build_tractions(const Scene& scene, System& system) {
  if (scene.tractions.empty()) return;
  std::vector<mpm::Traction> list;
  for (std::size_t n = 0; n < scene.tractions.size(); ++n) {
    const TractionDefinition& definition = scene.tractions[n];
    const std::string path = fmt::format("traction.{}", n);
    mpm::Traction traction;
    traction.body = static_cast<std::size_t>(
        std::ranges::find(scene.bodies, definition.body, &BodyDefinition::name) - scene.bodies.begin());
    traction.follows = definition.follows;
    if (definition.pressure)
      traction.pressure = load_function(scene, path + ".pressure", *definition.pressure);
    if (const auto pulse = pulse_of(definition)) traction.pressure = pulse_function(*pulse);
    for (std::size_t c = 0; definition.vector && c < 2; ++c)
      traction.vector[c] =
          load_function(scene, fmt::format("{}.vector.{}", path, c), (*definition.vector)[c]);
    traction.points = loaded_points(definition, scene.bodies[traction.body], system.axisymmetric,
                                    system.bodies[traction.body]);
    if (traction.points.empty())
      throw InputError(fmt::format(
          "{}: found nothing of the surface of body '{}' {}, expected a {} that holds a part of it "
          "at the start",
          scene.at(path + (definition.box ? ".box" : ".side")), definition.body,
          definition.box ? "in it" : "there", definition.box ? "box" : "side"));
    list.push_back(std::move(traction));
  }
  system.tractions = std::make_shared<mpm::Tractions>(system, std::move(list));
}

}  // namespace vitrum
