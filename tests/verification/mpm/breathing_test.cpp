#include <cmath>

#include "catch.hpp"
#include "support/mpm_measure.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

// Free radial vibration, u = A f(k R) cos(w t), w = k c_p. Cylinder in plane strain: f = J1 and no radial
// traction on the surface gives x J0(x) = (1 - 2 nu)/(1 - nu) J1(x); sphere: f = j1 and x j0(x) = 4 G/M
// j1(x); x = k R, G/M = (1 - 2 nu)/(2 - 2 nu).

namespace {

constexpr double ratio = (1.0 - 2.0 * unit_poisson) / (1.0 - unit_poisson);  // 2 G / M

double cylinder_root() {
  return root([](double x) { return x * std::cyl_bessel_j(0.0, x) - ratio * std::cyl_bessel_j(1.0, x); }, 1.0,
              3.0);
}
double sphere_root() {
  return root([](double x) { return x * std::sph_bessel(0U, x) - 2.0 * ratio * std::sph_bessel(1U, x); }, 1.5,
              4.0);
}

/// Gives every particle the radial velocity 1e-4 f(x R / radius) about the origin, lets the body swing for
/// three periods, and returns its frequency over the exact one, minus 1. spherical: the distance is measured
/// in r and z.
template <class Profile>
double frequency_error(const MpmScene& scene, double radius, double x, bool spherical, Profile profile) {
  MpmRun run(scene);
  Particles& p = run.particles();
  std::vector<double> mode_r(p.size), mode_z(p.size);
  for (std::size_t i = 0; i < p.size; ++i) {
    const double r = p.position[0][i], z = spherical ? p.position[1][i] : 0.0, distance = std::hypot(r, z);
    const double f = profile(x * distance / radius);
    mode_r[i] = f * r / distance, mode_z[i] = f * z / distance;
    p.velocity[0][i] = 1e-4 * mode_r[i], p.velocity[1][i] = 1e-4 * mode_z[i];
  }
  const double exact = x / radius;  // c_p = 1
  Oscillation swing;
  run.watch = [&](double) {
    double projection = 0.0;
    for (std::size_t i = 0; i < p.size; ++i)
      projection += p.mass[i] * (p.velocity[0][i] * mode_r[i] + p.velocity[1][i] * mode_z[i]);
    swing.add(run.system.time, projection);
    return true;
  };
  run.advance(3.0 * 2.0 * 3.14159265358979 / exact);
  REQUIRE(swing.zeros() >= 5);
  return swing.frequency() / exact - 1.0;
}

double j1_cylinder(double x) {
  return std::cyl_bessel_j(1.0, x);
}
double j1_sphere(double x) {
  return std::sph_bessel(1U, x);
}

/// A disc of the cylinder one cell high, axisymmetric with all axial motion held: plane strain.
double cylinder_error(const std::string& shape, int cells, const std::string& scheme = "usf") {
  MpmScene scene;
  scene.geometry = "axisymmetric", scene.shape = shape, scene.scheme = scheme, scene.pace = "courant = 0.2";
  scene.tables =
      body("cylinder", box({0.0, 0.0}, {static_cast<double>(cells), 1.0}), "particles_per_cell = 4") +
      hold_everywhere("z");
  return frequency_error(scene, cells, cylinder_root(), false, j1_cylinder);
}

}  // namespace

TEST_CASE("Plane-strain cylinder breathing, axisymmetric: the Bessel frequency, converging with the cell",
          "[verification][mpm]") {
  CHECK(cylinder_root() == Approx(2.0694).epsilon(1e-4));
  for (const char* shape : {"linear", "gimp", "bspline2"}) {
    const double coarse = cylinder_error(shape, 15), fine = cylinder_error(shape, 60);
    CAPTURE(shape, coarse, fine);
    CHECK(std::abs(coarse) < 1e-3);
    CHECK(std::abs(fine) < 1e-4);
    CHECK(order(std::abs(coarse), std::abs(fine), 4.0) > 1.7);
  }
  for (const char* scheme : {"usl", "musl"}) {
    const double error = cylinder_error("linear", 60, scheme);
    CAPTURE(scheme, error);
    CHECK(std::abs(error) < 1e-4);
  }
}

TEST_CASE("Plane-strain cylinder breathing on the (x, y) grid", "[verification][mpm]") {
  MpmScene scene;
  scene.tables = body("disk", disk({0.0, 0.0}, 20.0), "particles_per_cell = 4");
  const double error = frequency_error(scene, 20.0, cylinder_root(), true, j1_cylinder);
  CAPTURE(error);
  CHECK(std::abs(error) < 0.005);
}

TEST_CASE("Sphere breathing about the axis", "[verification][mpm]") {
  for (const char* shape : {"linear", "gimp", "bspline2"}) {
    MpmScene scene;
    scene.geometry = "axisymmetric", scene.shape = shape;
    scene.tables = body("sphere", disk({0.0, 0.0}, 20.0), "particles_per_cell = 4");
    const double error = frequency_error(scene, 20.0, sphere_root(), true, j1_sphere);
    CAPTURE(shape, error);
    CHECK(std::abs(error) < 0.005);
  }
}
