#include <cmath>
#include <numbers>
#include <numeric>

#include "scene/build_system.hpp"
#include "scene/read_scene.hpp"
#include "scene/shapes.hpp"
#include "scene/surface_patches.hpp"
#include "support/mpm_scene.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

struct Sample {
  const char* name;
  std::string shape;
  double plane, axisymmetric;  ///< length of the edge; area of the surface per radian
};

}  // namespace

TEST_CASE("Patches are the surface: its area, its normals, each with the nearest particle", "[contact]") {
  const double pi = std::numbers::pi;
  const Sample samples[] = {
      {"box on the axis", box({0.0, 0.0}, {4.0, 3.0}), 14.0, 2.0 * 8.0 + 4.0 * 3.0},
      {"box off the axis", box({2.0, 0.0}, {4.0, 3.0}), 10.0, 2.0 * 6.0 + 4.0 * 3.0 + 2.0 * 3.0},
      {"disk on the axis", disk({0.0, 5.0}, 3.0), 6.0 * pi, 2.0 * 9.0},
      {"disk off the axis", disk({5.0, 5.0}, 3.0), 6.0 * pi, 6.0 * pi * 5.0},
      {"ring", "ring = {centre = [0.0, 5.0], inner = 2.0, outer = 4.0}", 12.0 * pi, 2.0 * (16.0 + 4.0)},
      {"polygon, clockwise", "polygon = [[1.0, 0.0], [1.0, 3.0], [5.0, 0.0]]", 3.0 + 4.0 + 5.0,
       1.0 * 3.0 + 3.0 * 4.0 + 3.0 * 5.0},
  };
  for (const Sample& sample : samples)
    for (const char* geometry : {"plane-strain", "axisymmetric"}) {
      const bool plane = geometry == std::string("plane-strain");
      CAPTURE(sample.name, geometry);
      MpmScene text;
      text.geometry = geometry, text.cell = 0.5;
      text.tables = body("one", sample.shape, "particles_per_cell = 4");
      const Scene scene = parse_scene(text.text(), "test.toml");
      const System system = build_system(scene, 1);
      const Body& one = system.bodies[0];
      const std::vector<mpm::Patch> patches = surface_patches(scene.bodies[0].shape, scene.geometry, one);
      double area = 0.0;
      for (const mpm::Patch& patch : patches) {
        area += patch.length * patch.ring;
        CHECK(patch.length == Approx(0.25).epsilon(0.1));
        const auto& x = one.particles.position;
        const Vector2 middle{x[0][patch.carrier] + patch.offset[0], x[1][patch.carrier] + patch.offset[1]};
        const auto beside = [&](double by) {
          return contains(scene.bodies[0].shape,
                          {middle[0] + by * std::cos(patch.angle), middle[1] + by * std::sin(patch.angle)});
        };
        CHECK(beside(-0.05));
        CHECK_FALSE(beside(0.05));
        const double distance = std::hypot(patch.offset[0], patch.offset[1]);
        for (std::size_t i = 0; i < one.particles.size; ++i)
          if (!(std::hypot(x[0][i] - middle[0], x[1][i] - middle[1]) >= distance)) FAIL("not the nearest");
      }
      // A circle's rings have the radius of their middle: exact to the second order.
      CHECK(area == Approx(plane ? sample.plane : sample.axisymmetric).epsilon(2e-3));
    }
}

TEST_CASE("Patches know how round or sharp the surface is about them", "[contact]") {
  const double pi = std::numbers::pi;
  struct Curved {
    std::string shape;
    const char* geometry;
    double axis, expected;  ///< r and 1/m of the patch that is nearest to the line r = axis
  };
  const std::string bite = "\nhole = {disk = {centre = [5.0, 0.0], radius = 1.0}}";
  for (const Curved& c : {Curved{disk({5.0, 5.0}, 3.0), "plane-strain", 5.0, 1.0 / 3.0},
                          {disk({0.0, 5.0}, 3.0), "axisymmetric", 0.0, 1.0 / 3.0},
                          {box({0.0, 0.0}, {10.0, 3.0}), "plane-strain", 5.0, 0.0},
                          {box({0.0, 0.0}, {10.0, 3.0}), "plane-strain", 0.1, 0.5 * pi / 0.125},
                          {box({0.0, 0.0}, {10.0, 3.0}), "axisymmetric", 0.0, 0.0},
                          {box({0.0, 0.0}, {10.0, 3.0}) + bite, "plane-strain", 4.0, 0.5 * pi / 0.125},
                          {"polygon = [[0.0, 0.0], [4.0, 2.0], [0.0, 2.5]]", "axisymmetric", 0.0,
                           2.0 * std::atan(0.5) / 0.125}}) {
    CAPTURE(c.shape, c.geometry, c.axis);
    MpmScene text;
    text.geometry = c.geometry, text.cell = 0.5;
    text.tables = body("one", c.shape, "particles_per_cell = 4");
    const Scene scene = parse_scene(text.text(), "test.toml");
    const System system = build_system(scene, 1);
    const Body& one = system.bodies[0];
    double least = 1e300, found = -1.0;
    for (const mpm::Patch& patch : surface_patches(scene.bodies[0], scene.geometry, one)) {
      const double r = one.particles.position[0][patch.carrier] + patch.offset[0],
                   z = one.particles.position[1][patch.carrier] + patch.offset[1];
      // Of those that face down; the lowest.
      if (std::sin(patch.angle) < -0.5)
        if (const double away = std::abs(r - c.axis) + 1e-6 * z; away < least)
          least = away, found = patch.curvature;
    }
    CHECK(found == Approx(c.expected).epsilon(0.08).margin(1e-12));
  }
}
