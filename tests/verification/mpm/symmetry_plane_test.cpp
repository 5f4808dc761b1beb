// Half a body on a plane of symmetry moves as the half of a whole body does, for every shape function, method
// and position in the cell.
#include <cmath>

#include "catch.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// Planes through the origin across x and / or y (r, z), and on which side of them the half is.
struct Planes {
  bool across[2];
  double side;
};

std::string plane(std::size_t component, double side, const std::string& name) {
  const char* low = side > 0 ? "-inf" : "0";
  const char* high = side > 0 ? "0" : "inf";
  const auto corner = [&](const char* at, const char* other) {
    return component == 0 ? fmt::format("[{}, {}]", at, other) : fmt::format("[{}, {}]", other, at);
  };
  return hold(corner(low, "-inf"), corner(high, "inf"), "\"" + name + "\"");
}

/// images: how many copies of the block there are, which `mirror` puts in their places.
MpmScene blocks(const MpmScene& base, std::size_t images, const std::string& more) {
  MpmScene scene = base;
  for (std::size_t n = 0; n < images; ++n)
    scene.tables += body(fmt::format("block{}", n),
                         box({5.0 * static_cast<double>(n), 0.0}, {5.0 * static_cast<double>(n) + 3.0, 4.0}),
                         "particles_per_cell = 4");
  scene.tables += more;
  return scene;
}

/// Gives body 0 random places and velocities, `offset` cells from the planes, and the others those of its
/// mirror images.
void mirror(MpmRun& run, const Planes& planes, double offset) {
  Random random(7);
  Particles& first = run.particles(0);
  for (std::size_t i = 0; i < first.size; ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      double& x = first.position[k][i];
      x = std::max(x + random.uniform(-0.2, 0.2), 0.01);
      if (planes.across[k]) x = planes.side * (x + offset);
      first.velocity[k][i] = random.uniform(-0.01, 0.01);
      if (run.system.axisymmetric && k == 0) first.velocity[k][i] *= std::min(1.0, x);
    }
  for (std::size_t n = 1; n < run.system.bodies.size(); ++n) {
    Particles& p = run.particles(n);
    p.position = first.position, p.velocity = first.velocity, p.mass = first.mass;
    // Copies: by the bits of n for two planes, by the only plane for one.
    const bool both = planes.across[0] && planes.across[1];
    for (std::size_t k = 0; k < 2; ++k)
      if (both ? (n >> k & 1U) != 0 : planes.across[k])
        for (std::size_t i = 0; i < p.size; ++i) p.position[k][i] *= -1.0, p.velocity[k][i] *= -1.0;
  }
  run.system.grid_is_stale = true;
  run.reopen_ledger();
}

double largest_difference(const MpmRun& half, const MpmRun& whole) {
  const Particles &a = half.system.bodies[0].particles, &b = whole.system.bodies[0].particles;
  double largest = 0.0;
  const auto compare = [&](const auto& one, const auto& other, double scale) {
    for (std::size_t k = 0; k < one.size(); ++k)
      for (std::size_t i = 0; i < one[k].size(); ++i)
        largest = std::max(largest, std::abs(one[k][i] - other[k][i]) / scale);
  };
  compare(a.position, b.position, 1.0);
  compare(a.velocity, b.velocity, 0.01);
  compare(a.elastic_strain, b.elastic_strain, 0.01);
  return largest;
}

void require_symmetry(MpmScene base, const Planes& planes, double offset, double tolerance) {
  const bool axisymmetric = base.geometry == "axisymmetric";
  std::string held;
  const char* names[2] = {axisymmetric ? "r" : "x", axisymmetric ? "z" : "y"};
  std::size_t images = 1;
  for (std::size_t k = 0; k < 2; ++k)
    if (planes.across[k]) held += plane(k, planes.side, names[k]), images *= 2;
  // The seeds of side -1 lie behind the plane, where they would make the box one that holds material.
  const MpmScene half_scene = blocks(base, 1, planes.side > 0 ? held : "");
  MpmScene lower = base;
  lower.tables = body("block0",
                      box({planes.across[0] ? -3.0 : 0.0, planes.across[1] ? -4.0 : 0.0},
                          {planes.across[0] ? 0.0 : 3.0, planes.across[1] ? 0.0 : 4.0}),
                      "particles_per_cell = 4") +
                 held;
  MpmRun half(planes.side > 0 ? half_scene : lower), whole(blocks(base, images, ""));
  if (planes.side < 0) {  // the same seeds as those of the whole
    half.particles().position = whole.particles().position;
    half.particles().mass = whole.particles().mass;
  }
  mirror(half, planes, offset), mirror(whole, planes, offset);
  half.advance(1.5), whole.advance(1.5);
  CHECK(largest_difference(half, whole) < tolerance);
  CHECK(half.energy().kinetic ==
        Approx(whole.energy().kinetic / static_cast<double>(images)).epsilon(10.0 * tolerance));
  CHECK(half.energy().elastic ==
        Approx(whole.energy().elastic / static_cast<double>(images)).epsilon(10.0 * tolerance));
}

}  // namespace

TEST_CASE("Half a body on a plane of symmetry moves as half of the whole body",
          "[verification][mpm][symmetry]") {
  struct Method {
    const char *method, *scheme, *pace;
    double tolerance;
  };
  const Method methods[] = {
      {"explicit", "usf", "step = 0.05", 1e-11},
      {"explicit", "usl", "step = 0.01", 1e-11},
      {"explicit", "musl", "step = 0.05", 1e-11},
      {"arkode-explicit", "musl", "fixed_step = 0.1", 1e-11},
      {"arkode-implicit", "musl",
       "fixed_step = 0.1\nrtol = 1e-9\nvelocity_scale = 0.01\nstrain_scale = 0.01\nremap = 0.5", 1e-7},
  };
  struct Case {
    const char* geometry;
    Planes planes;
  };
  const Case cases[] = {{"plane-strain", {{false, true}, 1.0}}, {"plane-strain", {{false, true}, -1.0}},
                        {"plane-strain", {{true, false}, 1.0}}, {"plane-strain", {{true, true}, 1.0}},
                        {"plane-strain", {{true, true}, -1.0}}, {"axisymmetric", {{false, true}, 1.0}},
                        {"axisymmetric", {{false, true}, -1.0}}};
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const Method& m : methods)
      for (const Case& c : cases)
        for (const double offset : {0.0, 0.13, 0.4}) {
          CAPTURE(shape, m.method, m.scheme, c.geometry, c.planes.across[0], c.planes.across[1],
                  c.planes.side, offset);
          MpmScene base;
          base.geometry = c.geometry, base.shape = shape;
          base.method = m.method, base.scheme = m.scheme, base.pace = m.pace;
          require_symmetry(base, c.planes, offset, m.tolerance);
        }
}
