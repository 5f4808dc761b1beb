#include "scene/surface_patches.hpp"

#include "scene/nearest_particle.hpp"
#include "scene/surface_edges.hpp"

namespace vitrum {

std::vector<mpm::Patch> surface_patches(const Region& region, Geometry geometry, const Body& body) {
  const bool axisymmetric = geometry == Geometry::axisymmetric;
  const double spacing = 2.0 * body.particle_half_size;
  const NearestParticle nearest(body.particles, spacing);
  std::vector<mpm::Patch> patches;
  for (const Edge& edge : edges_of(region, axisymmetric)) {
    const int count = edge.pieces(spacing);
    for (int k = 0; k < count; ++k) {
      const double s = (k + 0.5) / count;
      const Vector2 middle = edge.place(s);
      if (axisymmetric && !(middle[0] > 1e-9 * spacing)) continue;
      const std::uint32_t carrier = nearest.to(middle);
      const auto& x = body.particles.position;
      patches.push_back({body.particles.identity[carrier],
                         {middle[0] - x[0][carrier], middle[1] - x[1][carrier]},
                         edge.normal(s),
                         edge.length() / count,
                         axisymmetric ? middle[0] : 1.0});
    }
  }
  return patches;
}

}  // namespace vitrum
