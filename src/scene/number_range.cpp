#include "scene/number_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/choices.hpp"
#include "scene/input_error.hpp"

namespace vitrum {
namespace {

/// What a double holds to all its digits, with room for shares of nodes (1e-15) below and sums over bodies
/// above.
constexpr double least = 1e-285, most = 1e285;

struct Quantity {
  const char* name;
  double low, high;  ///< over the body's particles
  const char* unit;
};

}  // namespace

void require_range(const Scene& scene, std::size_t index, const Body& body) {
  const Particles& p = body.particles;
  const auto [lightest, heaviest] = std::ranges::minmax(p.mass);
  double fastest = 0.0;
  for (std::size_t i = 0; i < p.size; ++i)
    fastest = std::max(fastest, std::hypot(p.velocity[0][i], p.velocity[1][i]));
  const double density = body.material->density(), wave = body.material->wave_speed();
  const double speed = fastest > 0.0 ? fastest : wave;
  const double crossing = scene.cell / wave;
  const Quantity quantities[] = {
      {"mass", lightest, heaviest, "kg"},
      {"volume", lightest / density, heaviest / density, "m^3"},
      {"energy at the speed of a wave", lightest * wave * wave, heaviest * wave * wave, "J"},
      {"kinetic energy", lightest * speed * speed, heaviest * speed * speed, "J"},
      {"time for a wave to cross a cell", crossing, crossing, "s"}};
  for (const Quantity& q : quantities) {
    if (q.low >= least && q.high <= most) continue;
    throw InputError(fmt::format(
        "{}: body '{}': found {} = {:.3g} {} of a particle, expected {:g} to {:g}: products of what lies "
        "beyond "
        "leave the range of numbers",
        scene.at(fmt::format("body.{}.{}", index, scene::shape_names[scene.bodies[index].shape.index()])),
        body.name, q.name, q.low >= least ? q.high : q.low, q.unit, least, most));
  }
}

}  // namespace vitrum
