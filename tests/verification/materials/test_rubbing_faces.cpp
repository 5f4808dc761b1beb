// Faces of a separated point that rub: Coulomb's cone, a brute-force slider, and flow behind them.
#include "support/reading_paths.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("flow and sliding together: neither surface is left, in few increments and in many",
          "[material][decohesion][reading]") {
  for (const NamedMaterial& named : rubbing_and_flowing()) {
    const MaterialParameters& p = named.parameters;
    const auto material = composite_of(p, cell);
    const double friction = p.decohesion->friction;
    Random random(7);
    int pressed = 0;
    for (int sample = 0; sample < 12; ++sample) {
      auto path = path_with_reversals(random, 6e-3, 4e3, 4);
      path.insert(path.begin(), {{3e-3, 0.0, 0.0, random.uniform(-1e-3, 1e-3)}, 1e-6});
      path.push_back({{-6e-3, 0.0, 0.0, random.uniform(-3e-3, 3e-3)}, 1e-6});
      auto all = solvers(1e-9);
      for (int method = 0; method < 2; ++method) {
        CAPTURE(named.name, sample, all[method].name);
        const Driven few = drive(*material, path, 2, {}, all[method].integrator.get()),
                     many = drive(*material, path, 50, {}, all[method].integrator.get());
        CAPTURE(few.cause, many.cause);
        REQUIRE((few.cause + many.cause).empty());
        CHECK(distance(few.state.stress, many.state.stress) < 1e4);
        CHECK(few.dissipation.total() == Approx(many.dissipation.total()).epsilon(1e-5).margin(10.0));
        const CompositeState& s = few.state;
        if (!is_separated(s)) continue;
        const SymmetricTensor d = deviator(s.stress);
        const double q = std::sqrt(1.5 * contract(d, d)), mean = trace(s.stress) / 3.0;
        if (p.drucker_prager && mean < 0.0)
          CHECK(q <= (1.0 + 1e-6) * (p.drucker_prager->yield - p.drucker_prager->beta * mean));
        const DecohesionPlane plane{s.normal};
        const double normal = plane.normal_part(s.stress), tangential = plane.tangential_part(s.stress);
        CHECK(std::abs(tangential) + friction * normal <= 1e3);
        pressed += s.plastic_strain > 0.0 && normal < -1e6;
      }
    }
    CAPTURE(named.name);
    CHECK(pressed > 0);
  }
}

TEST_CASE("closed faces stick up to Coulomb's cone, and slide on it", "[material][decohesion][reading]") {
  MaterialParameters p = cohesive_glass(5.0e-6);
  const double friction = 0.3, squeeze = 1e-3, shear = 2e-3;
  p.decohesion->friction = friction;
  const Moduli m = elastic_moduli(p.elastic);
  const double borne = friction * m.p_wave() * squeeze, yields = borne / (2.0 * m.shear);
  for (const double side : {1.0, -1.0}) {
    const Segment pressed{-squeeze * uniaxial, 1e-6}, sheared{{0.0, 0.0, 0.0, side * shear}, 1e-6},
        back{{0.0, 0.0, 0.0, -side * yields}, 1e-6}, parted{3.0 * squeeze * uniaxial, 1e-6};
    with_every_method(p, {pressed, sheared}, 1, separated_glass(p), [&](const Driven& d) {
      CHECK(d.state.stress.rz == Approx(side * borne).epsilon(1e-7));
      CHECK(d.state.opening_t == Approx(2.0 * side * cell * (shear - yields)).epsilon(1e-7));
      CHECK(d.dissipation.plastic == Approx(2.0 * borne * (shear - yields)).epsilon(1e-7));
      CHECK(d.dissipation.total() == d.dissipation.plastic);
    });
    with_every_method(p, {pressed, sheared, back}, 1, separated_glass(p), [&](const Driven& d) {
      CHECK(std::abs(d.state.stress.rz) < 1e-6 * borne);  // sticks: elastic
      CHECK(d.state.opening_t == Approx(2.0 * side * cell * (shear - yields)).epsilon(1e-7));
    });
    // While they part, what friction bears falls with the pressure, and its work is what was stored of shear.
    with_every_method(p, {pressed, sheared, parted}, 1, separated_glass(p), [&](const Driven& d) {
      CHECK(std::abs(d.state.stress.rz) < 1.0);
      CHECK(d.state.opening_n == Approx(2.0 * squeeze * cell).epsilon(1e-9));
      CHECK(d.state.opening_t == Approx(2.0 * side * cell * shear).epsilon(1e-7));
      CHECK(d.dissipation.plastic == Approx(2.0 * borne * (shear - 0.5 * yields)).epsilon(1e-6));
    });
    // Faces that meet under much shear slide from the first.
    const SymmetricTensor oblique{-squeeze, 0.0, 0.0, side * shear};
    CompositeState apart = separated_glass(p);
    apart.opening_n = 0.2 * squeeze * cell;
    with_every_method(p, {{oblique, 1e-6}}, 1, apart, [&](const Driven& d) {
      CHECK(d.state.stress.rz == Approx(0.8 * side * borne).epsilon(1e-7));
      CHECK(d.dissipation.plastic == Approx(0.64 * borne * (shear - yields)).epsilon(1e-6));
    });
  }
}

TEST_CASE("faces that rub, against a slider in a million steps", "[material][decohesion][reading]") {
  MaterialParameters p = cohesive_glass(5.0e-6);
  Random random(17);
  for (int sample = 0; sample < 6; ++sample) {
    p.decohesion->friction = random.uniform(0.1, 1.2);
    const Moduli m = elastic_moduli(p.elastic);
    const auto path = path_with_reversals(random, 2e-3, 1e4, 4);
    double gap = 0.0, slip = 0.0, work = 0.0;  // over the length
    SymmetricTensor total{};
    constexpr int steps = 200'000;
    for (const Segment& piece : path)
      for (int i = 0; i < steps; ++i) {
        total += (1.0 / steps) * piece.strain;
        const double pulled = m.stress(total).rr, wide = std::max(0.0, pulled / m.p_wave());
        const double pressing = std::max(0.0, -pulled), shear = 2.0 * m.shear * total.rz - m.shear * slip;
        const double held =
            std::clamp(shear, -p.decohesion->friction * pressing, p.decohesion->friction * pressing);
        gap = wide, slip += (shear - held) / m.shear, work += held * (shear - held) / m.shear;
      }
    with_every_method(p, path, 1, separated_glass(p), [&](const Driven& d) {
      CAPTURE(sample);
      CHECK(d.state.opening_n == Approx(cell * gap).margin(1e-9 * cell));
      CHECK(d.state.opening_t == Approx(cell * slip).margin(1e-7 * cell));
      CHECK(d.dissipation.plastic == Approx(work).epsilon(1e-3).margin(10.0));
    });
  }
}
