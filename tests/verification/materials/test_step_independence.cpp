#include "catch.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// What is known at the instant of localisation.
struct Onset {
  double time = -1.0;
  CompositeState state;  // just before
  CompositeState after;  // at the end of the path: the fields that localisation fixes
  double damage = 0.0;
};

Onset onset_of(const CompositeMaterial& material, const std::vector<Segment>& path, int steps,
               const CompositeState& start) {
  const Driven whole = drive(material, path, steps, start);
  Onset onset;
  onset.after = whole.state;
  onset.damage = whole.dissipation.damage;
  onset.time = whole.time_of(EventKind::localisation);
  if (onset.time < 0.0) return onset;
  // The same steps, cut off at the instant found.
  double time = 0.0;
  CompositeState s = start;
  for (const Segment& segment : path)
    for (int i = 0; i < steps; ++i) {
      const double step = segment.duration / steps;
      const double share = std::clamp((onset.time * (1.0 - 1e-13) - time) / step, 0.0, 1.0);
      if (share <= 0.0) continue;
      PointReport report;
      material.respond(s, (share / steps) * segment.strain, share * step, report);
      time += step;
    }
  onset.state = s;
  return onset;
}

void require_same(const Onset& a, const Onset& b) {
  REQUIRE((a.time >= 0.0) == (b.time >= 0.0));
  if (a.time < 0.0) return;
  REQUIRE(b.time == Approx(a.time).epsilon(1e-9));
  REQUIRE(b.after.crack_density == Approx(a.after.crack_density).epsilon(1e-9));
  REQUIRE(b.after.cohesive_strength == Approx(a.after.cohesive_strength).epsilon(1e-9));
  REQUIRE(b.after.effective_length == Approx(a.after.effective_length).epsilon(1e-9));
  REQUIRE(b.after.max_rate == Approx(a.after.max_rate).epsilon(1e-9));
  REQUIRE(distance(a.state.stress, b.state.stress) < 1e-9 * norm(a.state.stress));
  REQUIRE(b.damage == Approx(a.damage).epsilon(1e-4));
}

int compare_steps(const CompositeMaterial& material, const std::vector<Segment>& path,
                  const CompositeState& start = {}) {
  const Onset one = onset_of(material, path, 1, start);
  for (const int steps : {10, 1000}) {
    CAPTURE(steps, one.time);
    require_same(one, onset_of(material, path, steps, start));
  }
  return one.time >= 0.0 ? 1 : 0;
}

}  // namespace

TEST_CASE("localisation does not depend on the step: straight paths of glass",
          "[material][damage][step-independence]") {
  Random random(100);
  for (const bool all : {false, true}) {
    const auto glass = composite_of(fracturing_glass(all), cell);
    int localised = 0;
    for (int i = 0; i < 250; ++i) {
      SymmetricTensor direction = random.direction();
      if (trace(direction) < 0.0) direction *= -1.0;
      const double rate = random.logarithmic(10.0, 1e5);
      const double strain = random.uniform(0.5, 3.0) * 3e-4 * std::cbrt(rate);
      CAPTURE(all, i, direction.rr, direction.zz, direction.tt, direction.rz, rate);
      localised += compare_steps(*glass, {{strain * direction, strain * trace(direction) / (3.0 * rate)}});
    }
    CHECK(localised > 100);
  }
}

TEST_CASE("localisation does not depend on the step: paths of several segments in glass",
          "[material][damage][step-independence]") {
  Random random(101);
  for (const bool all : {false, true}) {
    const auto glass = composite_of(fracturing_glass(all), cell);
    int localised = 0;
    for (int i = 0; i < 250; ++i) {
      std::vector<Segment> path;
      for (int k = 0; k < 5; ++k) {
        const double size = random.logarithmic(1e-4, 3e-3);
        const SymmetricTensor e = random.tensor(size) + random.uniform(-0.3, 0.5) * size * identity();
        path.push_back({e, random.logarithmic(1e-8, 1e-5)});
      }
      CAPTURE(all, i);
      localised += compare_steps(*glass, path);
    }
    CHECK(localised > 60);
  }
}

TEST_CASE("localisation is not missed where damage resumes and the strain turns away at once",
          "[material][damage][step-independence]") {
  // Hydrostatic growth, unloading, a deviator that is critical when the trace comes back, then away from it.
  Random random(102);
  const auto glass = composite_of(fracturing_glass(false), cell);
  int localised = 0;
  for (int i = 0; i < 300; ++i) {
    const double rate = 1.0e3, mean = random.uniform(4.6e-4, 5.1e-4);  // hydrostatic onset: 5.188e-4
    const double back = random.uniform(0.02, 0.2) * mean, shear = random.logarithmic(1e-4, 3e-3);
    const SymmetricTensor deviator_there = shear * SymmetricTensor{1.0, -1.0, 0.0, 0.3};
    const double forth = back * random.uniform(1.001, 1.3);
    const std::vector<Segment> path{
        {mean * identity(), mean / rate},
        {deviator_there - back * identity(), 1e-6},
        {forth * identity() - random.uniform(0.5, 1.5) * deviator_there, forth / rate}};
    CAPTURE(i, mean, back, shear);
    localised += compare_steps(*glass, path);
  }
  CHECK(localised > 30);
}

TEST_CASE("localisation of steel does not depend on the step on proportional paths",
          "[material][von_mises][step-independence]") {
  Random random(103);
  MaterialParameters p = fracturing_steel(false);
  p.von_mises->softening = 30.0e9;
  const auto steel = composite_of(p, cell);
  int localised = 0;
  for (int i = 0; i < 200; ++i) {
    const SymmetricTensor strain =
        0.06 * random.deviatoric_direction() + random.uniform(-0.01, 0.01) * identity();
    CAPTURE(i);
    localised += compare_steps(*steel, {{strain, 1e-4}});
  }
  CHECK(localised > 30);
}

TEST_CASE("separation in mode I does not depend on the step", "[material][decohesion][step-independence]") {
  const auto glass = composite_of(fracturing_glass(false), cell);
  for (const double rate : {10.0, 1e3, 3e4, 1e5}) {
    const double strain = 0.03;
    const std::vector<Segment> path{{{strain, 0.0, 0.0, 0.0}, strain / (3.0 * rate)}};
    const Driven one = drive(*glass, path, 1);
    REQUIRE(is_separated(one.state));
    for (const int steps : {7, 100, 1000}) {
      const Driven many = drive(*glass, path, steps);
      CAPTURE(rate, steps);
      CHECK(many.time_of(EventKind::separation) == Approx(one.time_of(EventKind::separation)).epsilon(1e-9));
      CHECK(many.state.opening_n == Approx(one.state.opening_n).epsilon(1e-9));
      CHECK(many.dissipation.fracture == Approx(one.dissipation.fracture).epsilon(1e-8));
      CHECK(distance(many.state.stress, one.state.stress) < 1.0);
    }
  }
}
