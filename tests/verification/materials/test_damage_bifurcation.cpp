#include <optional>

#include "catch.hpp"
#include "support/acoustic_scan.hpp"
#include "support/literal_damage.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

struct Plane {
  double x;                     // 16 rho_d / 9 at onset
  std::optional<double> angle;  // none: hoop
};

/// Scans det(n.T.n) of the literal law along a proportional path at constant rate; the path is described by
/// x.
std::optional<Plane> brute_force_onset(const SymmetricTensor& direction, double rate, bool all_planes) {
  const LiteralDamage literal = literal_glass();
  const double C = literal.coefficient(rate);
  const auto tangent_at = [&](double x) {
    const double mean = std::pow(x * 9.0 / 16.0 / C, 1.0 / 6.0);
    return literal.tangent((3.0 * mean / trace(direction)) * direction, C);
  };
  const auto in_plane = [&](const LiteralDamage::Matrix& T) { return scan_normals(T, 16); };
  const auto critical = [&](double x) {
    const auto T = tangent_at(x);
    return in_plane(T).determinant <= 0.0 || (all_planes && hoop_acoustic(T) <= 0.0);
  };
  double low = 1e-6, high = 0.0;
  for (double x = 0.02; x < 0.9999; x += 0.02) {
    if (critical(x)) {
      high = x;
      break;
    }
    low = x;
  }
  if (high == 0.0) return {};
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (critical(middle) ? high : low) = middle;
  }
  const auto T = tangent_at(high);
  const ScannedPlane scanned = in_plane(T);
  if (all_planes && scanned.determinant > 0.0) return Plane{high, {}};
  return Plane{high, scanned.angle};
}

struct Tally {
  int localised = 0, intact = 0, hoop = 0;
  double worst_x = 0.0, worst_angle = 0.0, largest_damage = 0.0;
};

/// Compares one increment of the material that runs through the whole life of the damage with the scan.
Tally compare(int states, bool all_planes, std::uint64_t seed) {
  const auto glass = composite_of(fracturing_glass(all_planes), cell);
  Random random(seed);
  Tally tally;
  while (tally.localised + tally.intact < states) {
    SymmetricTensor direction = random.direction();
    if (trace(direction) < 0.0) direction *= -1.0;
    if (trace(direction) < 0.02) continue;
    const double rate = random.logarithmic(10.0, 1.0e5);
    const double full = std::pow(crack_density_limit / literal_glass().coefficient(rate), 1.0 / 6.0);
    const SymmetricTensor strain = (1.1 * 3.0 * full / trace(direction)) * direction;
    const Driven driven = drive(*glass, {{strain, 1.1 * full / rate}}, 1);
    const auto expected = brute_force_onset(direction, rate, all_planes);
    CAPTURE(direction.rr, direction.zz, direction.tt, direction.rz, rate);
    REQUIRE(is_localised(driven.state) == expected.has_value());
    if (!expected) {
      ++tally.intact;
      REQUIRE(driven.state.crack_density == crack_density_limit);
      continue;
    }
    ++tally.localised;
    const double x = driven.state.crack_density / crack_density_limit;
    tally.worst_x = std::max(tally.worst_x, std::abs(x - expected->x));
    tally.largest_damage =
        std::max(tally.largest_damage, literal_glass().moduli(driven.state.crack_density).damage);
    const bool hoop = driven.state.normal.r == 0.0 && driven.state.normal.z == 0.0;
    const InPlanePrincipal p = in_plane_principal(direction);
    if (all_planes && std::abs(p.major - direction.tt) < 1e-4) continue;  // either plane will do
    REQUIRE(hoop == !expected->angle.has_value());
    if (hoop) ++tally.hoop;
    if (hoop || p.major - p.minor < 1e-2 * trace(direction)) continue;  // every in-plane normal will do
    const double angle = std::atan2(driven.state.normal.z, driven.state.normal.r);
    tally.worst_angle = std::max(tally.worst_angle, axis_difference(angle, *expected->angle));
  }
  return tally;
}

}  // namespace

TEST_CASE("onset and plane of localisation against a scan of det(n.T.n), normals in the plane",
          "[material][damage][bifurcation]") {
  const Tally tally = compare(10000, false, 5);
  CHECK(tally.worst_x < 1e-6);
  CHECK(tally.worst_angle < 1e-4);
  CHECK(tally.localised > 7000);
  CHECK(tally.intact > 100);
}

TEST_CASE("onset and plane of localisation against a scan of det(n.T.n), hoop normal included",
          "[material][damage][bifurcation]") {
  const Tally tally = compare(4000, true, 6);
  CHECK(tally.worst_x < 1e-6);
  CHECK(tally.worst_angle < 1e-4);
  CHECK(tally.intact == 0);
  CHECK(tally.hoop > 1000);
  CHECK(tally.largest_damage <= 0.27213);
}

TEST_CASE("a dominant hoop strain keeps in-plane normals from localising",
          "[material][damage][bifurcation]") {
  const auto glass = composite_of(fracturing_glass(false), cell);
  // Largest in-plane strain over the trace: localises above -0.2173.
  for (const double ratio : {-0.2175, -0.30, -1.0}) {
    const SymmetricTensor e{ratio, ratio - 0.1, 1.1 - 2.0 * ratio, 0.0};
    const Driven driven = drive(*glass, {{1e-2 * e, 1e-6}}, 1);
    CHECK_FALSE(is_localised(driven.state));
    CHECK(glass->damage(driven.state) == 1.0);
  }
  const SymmetricTensor e{-0.2170, -0.3170, 1.534, 0.0};
  CHECK(is_localised(drive(*glass, {{1e-2 * e, 1e-6}}, 1).state));
}

TEST_CASE("plane and crack density at localisation do not depend on the rate",
          "[material][damage][bifurcation]") {
  const auto glass = composite_of(fracturing_glass(false), cell);
  const SymmetricTensor direction{0.8, 0.2, -0.1, 0.35};
  const Driven reference = drive(*glass, {{3e-3 * direction, 3e-3}}, 1);
  for (const double duration : {3e-5, 3e-7, 3e-8}) {
    const Driven other = drive(*glass, {{1e-1 * direction, duration}}, 1);
    CHECK(other.state.crack_density == Approx(reference.state.crack_density).epsilon(1e-12));
    CHECK(other.state.normal.r == Approx(reference.state.normal.r).epsilon(1e-12));
    CHECK(other.state.normal.z == Approx(reference.state.normal.z).epsilon(1e-12));
  }
}
