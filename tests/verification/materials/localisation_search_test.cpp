// The search for the first critical state of an increment, which passes over what its bounds exclude, against
// one that looks everywhere.
#include "catch.hpp"
#include "materials/root.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double rate = 1.0e3;  // 1/s, of the past; increments are slower

/// The criterion along straight paths while damage grows at one rate, by its formula.
struct Criterion {
  DamageLaw law;
  DecohesionParameters plane;
  double coefficient;

  explicit Criterion(const MaterialParameters& p)
      : law(*p.damage, p.elastic), plane(*p.decohesion), coefficient(law.coefficient(rate)) {}

  double target(const SymmetricTensor& e) const {
    return law.target(law.strain_of(trace(e)), coefficient) / crack_density_limit;
  }
  double phi(double x, const SymmetricTensor& e) const {
    const double major = in_plane_principal(e).major;
    return law.bifurcation(x, trace(e), plane.search_all_planes ? std::max(major, e.tt) : major);
  }
  /// Least stress over 2 G_bar and the size of the strain.
  double least_stress(double x, const SymmetricTensor& e) const {
    return (law.lateral_ratio(x) * trace(e) + std::min(in_plane_principal(e).minor, e.tt)) / norm(e);
  }
  /// What is to be not positive.
  double operator()(double x, const SymmetricTensor& e) const {
    return plane.partial_compression ? phi(x, e) : std::max(phi(x, e), -1e-9 - least_stress(x, e));
  }
};

struct Increment {
  SymmetricTensor start, strain;
  double x;  // of the start, which lies on eq. 7
};

/// An increment by a thousandth of the strain up to all of it from a state on eq. 7 that is close to the
/// onset of a proportional path, or anywhere where there is none.
Increment random_increment(Random& random, const Criterion& criterion) {
  for (;;) {
    const SymmetricTensor direction = random.direction();
    if (trace(direction) < 0.02) continue;
    const auto reached = [&](double x) { return criterion.phi(x, direction) <= 0.0; };
    const double onset = reached(0.999) ? first_reached(0.0, 0.999, reached) : random.uniform(0.1, 0.95);
    const double x = onset * (1.0 - random.logarithmic(1e-5, 0.3));
    const double strain = criterion.law.strain_at(x * crack_density_limit, criterion.coefficient);
    Increment i{(criterion.law.trace_of(strain) / trace(direction)) * direction, {}, 0.0};
    i.x = criterion.target(i.start);
    i.strain = random.logarithmic(1e-3, 1.0) * norm(i.start) * random.direction();
    if (trace(i.strain) > 0.0 && criterion(i.x, i.start) > 0.0) return i;
  }
}

struct Tally {
  int localised = 0, intact = 0, hoop = 0;
};

Tally compare(const MaterialParameters& p, int increments, std::uint64_t seed) {
  const auto material = composite_of(p, cell);
  const Criterion criterion(p);
  Random random(seed);
  Tally tally;
  for (int n = 0; n < increments; ++n) {
    const Increment increment = random_increment(random, criterion);
    const auto value = [&](double f) {
      const SymmetricTensor e = increment.start + f * increment.strain;
      const double x = criterion.target(e);
      return x > increment.x ? criterion(x, e) : 1.0;
    };
    constexpr int samples = 64;
    double expected = 2.0;
    for (int k = 1; k <= samples && expected > 1.0; ++k)
      if (value(k / double(samples)) <= 0.0)
        expected = first_reached((k - 1) / double(samples), k / double(samples),
                                 [&](double f) { return value(f) <= 0.0; });
    CompositeState s;
    s.elastic_strain = increment.start, s.max_rate = rate,
    s.crack_density = increment.x * crack_density_limit;
    PointReport report;
    material->respond(s, increment.strain, trace(increment.strain) / rate, report);
    double found = 2.0;
    for (std::size_t k = 0; k < report.events.size(); ++k)
      if (report.events[k].kind == EventKind::localisation) found = report.events[k].fraction;
    CAPTURE(n, found, expected, increment.x);
    REQUIRE(found <= expected + 1e-9);
    if (found > 1.0) {
      ++tally.intact;
      continue;
    }
    ++tally.localised;
    // Where the samples passed over an onset, it is one: critical, and not a moment before.
    REQUIRE(value(found) <= 1e-10);
    if (found < expected - 1e-9) REQUIRE(value(found - 1e-8) > 0.0);
    const SymmetricTensor e = increment.start + found * increment.strain;
    const InPlanePrincipal principal = in_plane_principal(e);
    if (p.decohesion->search_all_planes && e.tt > principal.major) {
      ++tally.hoop;
      REQUIRE(s.normal == PlaneVector{});
    } else {
      const double cosine = s.normal.r * principal.direction_r + s.normal.z * principal.direction_z;
      REQUIRE(std::abs(cosine) == Approx(1.0).epsilon(1e-9));
    }
  }
  return tally;
}

}  // namespace

TEST_CASE("the first localisation of an increment against a search that looks everywhere",
          "[material][damage][bifurcation]") {
  for (const bool all : {false, true})
    for (const bool compressed : {true, false})
      for (const double poisson : {-0.5, 0.0, 0.25, 0.39}) {
        MaterialParameters p = fracturing_glass(all);
        p.elastic.poisson = poisson;
        p.decohesion->partial_compression = compressed;
        CAPTURE(all, compressed, poisson);
        const Tally tally = compare(p, 7000, 17);
        CHECK(tally.localised > 500);
        CHECK(tally.intact > 500);
        CHECK((tally.hoop > 100) == all);
      }
}

TEST_CASE("damage that grows for good without localising is not searched to the last bit",
          "[material][damage][bifurcation]") {
  // The hoop strain rules, and normals in the plane do not localise: 20,000 increments, each of which would
  // be halved a million times without a bound.
  const MaterialParameters p = fracturing_glass(false);
  const Driven d =
      drive(*composite_of(p, cell), {{1e-2 * SymmetricTensor{-0.3, -0.4, 1.7, 0.0}, 1e-6}}, 20000);
  CHECK(!is_localised(d.state));
  CHECK(d.state.crack_density == crack_density_limit);
}
