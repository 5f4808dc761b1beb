#include "catch.hpp"
#include "support/acoustic_scan.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double K = 130.0e9, G = 78.0e9, root = 0.816496580927726;

/// E - H s (x) s written out component by component (eq. 24).
TangentMatrix literal_tangent(const SymmetricTensor& s, double H) {
  const std::array<double, 4> stress{s.rr, s.zz, s.tt, s.rz}, gradient{s.rr, s.zz, s.tt, 2.0 * s.rz};
  TangentMatrix T{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) T[i][j] = K - 2.0 / 3.0 * G;
  for (std::size_t i = 0; i < 4; ++i) {
    T[i][i] += 2.0 * G;
    for (std::size_t j = 0; j < 4; ++j) T[i][j] -= H * stress[i] * gradient[j];
  }
  return T;
}

struct Critical {
  double H;
  bool hoop;
  double angle;
};
/// The smallest H at which some det(n.T.n) vanishes, by bisection over scans.
Critical brute_force_critical(const SymmetricTensor& s, bool all) {
  double low = 0.0, high = 10.0 * K / contract(s, s);
  const auto critical = [&](double H) {
    const TangentMatrix T = literal_tangent(s, H);
    return scan_normals(T, 40).determinant <= 0.0 || (all && hoop_acoustic(T) <= 0.0);
  };
  while (!critical(high)) high *= 4.0;
  for (int i = 0; i < 48; ++i) {
    const double middle = 0.5 * (low + high);
    (critical(middle) ? high : low) = middle;
  }
  const TangentMatrix T = literal_tangent(s, high);
  const ScannedPlane plane = scan_normals(T, 40);
  return {high, all && plane.determinant > 0.0, plane.angle};
}

double softening_drop(double softening) {
  return 4.0 * G * G / (2.0 * G - root * softening);
}

Driven pull(const MaterialParameters& p, const SymmetricTensor& direction, int steps) {
  return drive(*composite_of(p, cell), {{(0.06 / norm(direction)) * direction, 1.0}}, steps);
}

}  // namespace

TEST_CASE("critical plane of von Mises flow against a scan of det(n.T.n)",
          "[material][von_mises][bifurcation]") {
  Random random(30);
  const Moduli moduli{K, G};
  int clamped = 0, hoop = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool all = random.chance(0.5);
    const SymmetricTensor s = random.logarithmic(1e6, 1e9) * random.deviatoric_direction();
    const double drop = softening_drop(random.uniform(0.0, 60e9));
    const CriticalPlane found = von_mises_critical_plane(s, moduli, drop, all);
    const Critical expected = brute_force_critical(s, all);
    CAPTURE(all, s.rr, s.zz, s.tt, s.rz);
    REQUIRE(found.severity == Approx(drop / contract(s, s) / expected.H).epsilon(1e-9));

    const InPlanePrincipal p = in_plane_principal(s);
    const bool found_hoop = found.normal.r == 0.0 && found.normal.z == 0.0;
    REQUIRE(found_hoop == expected.hoop);
    if (found_hoop) {
      ++hoop;
      continue;
    }
    REQUIRE(std::hypot(found.normal.r, found.normal.z) == Approx(1.0).epsilon(1e-12));
    // Both signs of theta are critical: compare the angle to the major axis.
    const double axis = std::atan2(p.direction_z, p.direction_r);
    const double theta = axis_difference(std::atan2(found.normal.z, found.normal.r), axis);
    const double scanned = axis_difference(expected.angle, axis);
    const double cosine = 3.0 * G * 0.5 * (p.major + p.minor) / ((G + 3.0 * K) * 0.5 * (p.major - p.minor));
    if (std::abs(cosine) > 1.0) ++clamped;
    // Where theta meets an axis the determinant is flat to fourth order, and the scan loses the angle.
    if (std::abs(std::abs(cosine) - 1.0) > 0.02) REQUIRE(std::abs(theta - scanned) < 1e-4);
  }
  CHECK(clamped > 100);
  CHECK(hoop > 100);
}

TEST_CASE("critical plane of von Mises flow against eqs. 25 and 26 where the hoop stress is intermediate",
          "[material][von_mises][bifurcation]") {
  Random random(31);
  for (int i = 0; i < 2000; ++i) {
    const SymmetricTensor s = 1e8 * random.deviatoric_direction();
    const InPlanePrincipal p = in_plane_principal(s);
    if (s.tt > p.major || s.tt < p.minor) continue;
    const double s0 = trace(s) / 3.0, sc = 0.5 * (p.major + p.minor), r = 0.5 * (p.major - p.minor);
    const double critical = (G * G + 3.0 * K * G) / (3.0 * G * (s0 - sc) * (s0 - sc) + (G + 3.0 * K) * r * r);
    const double theta = std::atan(
        std::sqrt((3.0 * G * (sc - s0) - (G + 3.0 * K) * r) / (3.0 * G * (s0 - sc) - (G + 3.0 * K) * r)));
    const double drop = softening_drop(9.6e9);
    const CriticalPlane plane = von_mises_critical_plane(s, {K, G}, drop, true);
    REQUIRE(plane.severity == Approx(drop / contract(s, s) / critical).epsilon(1e-12));
    const double axis = std::atan2(p.direction_z, p.direction_r);
    REQUIRE(axis_difference(std::atan2(plane.normal.z, plane.normal.r), axis) == Approx(theta).epsilon(1e-9));
  }
}

TEST_CASE("pure shear and plane strain localise exactly at the peak", "[material][von_mises][bifurcation]") {
  const double yielded = root * 359.0e6 / (2.0 * G), peak = 125.0 / 9600.0;
  const double at = (yielded + peak * (1.0 + root * 9.6e9 / (2.0 * G))) / 0.06;
  for (const SymmetricTensor& direction :
       {SymmetricTensor{0.0, 0.0, 0.0, 1.0}, SymmetricTensor{1.0, -1.0, 0.0, 0.0},
        SymmetricTensor{0.6, -0.6, 0.0, 0.8}})
    for (const int steps : {1, 3, 100}) {
      CAPTURE(direction.rr, direction.rz, steps);
      const Driven d = pull(fracturing_steel(), direction, steps);
      REQUIRE(is_localised(d.state));
      CHECK(d.time_of(EventKind::localisation) == Approx(at).epsilon(1e-9));
      CHECK(d.time_of(EventKind::peak) == Approx(at).epsilon(1e-9));
      // n at 45 degrees to the principal axes: all shear, and the traction is the radius over sqrt(2), on
      // both modes alike.
      CHECK(d.state.cohesive_strength == Approx(root * 484.0e6 / std::sqrt(2.0)).epsilon(1e-9));
    }
}

TEST_CASE("uniaxial stress and strain localise only with a steep softening",
          "[material][von_mises][bifurcation]") {
  for (const bool all : {false, true})
    for (const double sign : {1.0, -1.0})
      for (const SymmetricTensor& direction :
           {SymmetricTensor{2.0, -1.0, -1.0, 0.0}, SymmetricTensor{-1.0, 2.0, -1.0, 0.0}}) {
        CAPTURE(all, sign);
        MaterialParameters p = fracturing_steel(all);
        for (const double softening : {9.6e9, 39.7e9}) {
          p.von_mises->softening = softening;
          CHECK_FALSE(is_localised(pull(p, sign * direction, 5).state));
        }
        p.von_mises->softening = 39.9e9;
        CHECK(is_localised(pull(p, sign * direction, 5).state));
      }
}
