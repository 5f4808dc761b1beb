// What the paper leaves open after eq. 7: each reading against its closed form, every local method against
// the others, and the account.
#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/local_solvers.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr SymmetricTensor uniaxial{1.0, 0.0, 0.0, 0.0};

/// Calls `check` with the end of the path under the closed form and under every solver.
void with_every_method(const MaterialParameters& p, const std::vector<Segment>& path, int steps,
                       const CompositeState& start, const std::function<void(const Driven&)>& check) {
  const auto material = composite_of(p, cell);
  check(drive(*material, path, steps, start));
  for (LocalSolver& solver : solvers(1e-9)) {
    CAPTURE(solver.name);
    const Driven d = drive(*material, path, steps, start, solver.integrator.get());
    REQUIRE(d.cause.empty());
    check(d);
  }
}

MaterialParameters glass_with(const std::function<void(MaterialParameters&)>& choose) {
  MaterialParameters p = fracturing_glass();
  p.drucker_prager = glass_drucker_prager();
  choose(p);
  return p;
}
Segment stretch(double strain, double rate) {
  return {strain * uniaxial, std::abs(strain) / rate};
}

/// A point of glass without damage whose plane, normal to r, has just separated; its faces touch.
CompositeState separated_glass(const MaterialParameters& p) {
  CompositeState s = at_onset(*composite_of(p, cell), 0.0, 50.0e6, {});
  s.decohesion = 1.0;
  return s;
}

}  // namespace

TEST_CASE("eq. 7 with the speed of pressure waves: less crack density by the square of the speeds",
          "[material][damage][reading]") {
  const auto density = [](bool pressure_wave) {
    const MaterialParameters p =
        glass_with([&](MaterialParameters& g) { g.damage->pressure_wave = pressure_wave; });
    return drive(*composite_of(p, cell), {stretch(5e-4, 3e3)}, 1).state.crack_density;
  };
  const ElasticParameters glass = bare_glass().elastic;
  CHECK(density(true) / density(false) ==
        Approx(glass.young / elastic_moduli(glass).p_wave()).epsilon(1e-12));
}

TEST_CASE("eq. 10 with undamaged moduli: the stress keeps at the onset, which is booked",
          "[material][decohesion][reading][energy]") {
  const MaterialParameters plain = glass_with([](MaterialParameters&) {}),
                           p = glass_with([](MaterialParameters&g) { g.decohesion->undamaged = true; });
  const double rate = 3e3;
  const double onset =
      drive(*composite_of(plain, cell), {stretch(3e-3, rate)}, 1).time_of(EventKind::localisation) * rate;
  const std::vector<Segment> back{stretch(onset * (1.0 + 1e-9), rate), stretch(-2e-4, rate)};
  const Driven damaged = drive(*composite_of(plain, cell), {back[0]}, 1);
  const Moduli virgin = elastic_moduli(p.elastic);
  REQUIRE(is_localised(damaged.state));
  with_every_method(p, {back[0]}, 1, {}, [&](const Driven& d) {
    CHECK(distance(d.state.stress, damaged.state.stress) < 1e-5 * norm(damaged.state.stress));
    CHECK(d.state.crack_density == Approx(damaged.state.crack_density).epsilon(1e-6));
    const double set_free = composite_of(plain, cell)->stored_energy(damaged.state) -
                            virgin.energy(virgin.strain(damaged.state.stress));
    CHECK(d.dissipation.damage - damaged.dissipation.damage == Approx(set_free).epsilon(1e-4));
  });
  with_every_method(p, back, 1, {}, [&](const Driven& d) {  // unloading finds the virgin stiffness
    const SymmetricTensor expected = damaged.state.stress + virgin.stress(-2e-4 * uniaxial);
    CHECK(distance(d.state.stress, expected) < 1e-5 * norm(expected));
  });
}

TEST_CASE("a given tau_bar_0 gives every plane one energy, whatever its strength",
          "[material][decohesion][reading][energy]") {
  const double tau_bar_0 = 60.0e6;
  const MaterialParameters p =
      glass_with([&](MaterialParameters& g) { g.decohesion->tau_bar_0 = tau_bar_0; });
  std::vector<double> strengths;
  for (const double rate : {30.0, 300.0, 1500.0})
    with_every_method(p, {stretch(2e-2, rate)}, 1, {}, [&](const Driven& d) {
      REQUIRE(is_separated(d.state));
      REQUIRE(d.dissipation.snap_back <= 1e-6 * d.dissipation.fracture);
      CHECK(d.dissipation.fracture * cell == Approx(0.5 * 5.0e-6 * tau_bar_0).epsilon(1e-5));
      strengths.push_back(d.state.cohesive_strength);
    });
  CHECK(strengths.back() > 2.0 * strengths.front());
}

TEST_CASE("eqs. 15 to 18 as printed: pressure decoheres, and crushed faces touch where they are",
          "[material][decohesion][reading]") {
  MaterialParameters p = cohesive_glass(5.0e-6);
  p.decohesion->pressure_counts = true;
  const double strength = 50.0e6, M = elastic_moduli(p.elastic).p_wave();
  const CompositeState start = at_onset(*composite_of(p, cell), 0.0, strength, {});
  // Shortens beyond the separation at u0 and strength/M.
  with_every_method(p, {stretch(-1e-2, 1e2)}, 1, start, [&](const Driven& d) {
    REQUIRE(is_separated(d.state));
    CHECK(d.time_of(EventKind::separation) == Approx((5.0e-6 / cell) / 1e2).epsilon(1e-6));
    CHECK(d.dissipation.fracture * cell == Approx(0.5 * 5.0e-6 * strength).epsilon(1e-6));
    CHECK(d.state.opening_n == 0.0);
    CHECK(d.state.stress.rr == Approx(-M * (1e-2 - 5.0e-6 / cell)).epsilon(1e-6));
  });
  p.decohesion->pressure_counts = false;
  with_every_method(p, {stretch(-1e-2, 1e2)}, 1, start,
                    [&](const Driven& d) { CHECK(d.state.decohesion == 0.0); });
}

TEST_CASE("no localisation under partial compression, no difference without",
          "[material][decohesion][reading]") {
  const auto with = [](bool partial) {
    return glass_with([&](MaterialParameters& g) { g.decohesion->partial_compression = partial; });
  };
  const SymmetricTensor pulled{1.0, -0.4, -0.4, 0.0};  // the lateral stress is a compression
  with_every_method(with(true), {{8e-3 * pulled, 1e-5}}, 7, {},
                    [](const Driven& d) { CHECK(is_localised(d.state)); });
  with_every_method(with(false), {{8e-3 * pulled, 1e-5}}, 7, {}, [](const Driven& d) {
    CHECK(!is_localised(d.state));
    CHECK(d.state.crack_density > 0.0);
  });
  // Where compression ends while damage grows, the point localises.
  const std::vector<Segment> turning{{2.4e-3 * pulled, 3e-6}, {{-1.5e-3, 0.85e-3, 0.85e-3, 0.0}, 3e-6}};
  double first = -1.0;
  with_every_method(with(false), turning, 7, {}, [&](const Driven& d) {
    const double at = d.time_of(EventKind::localisation);
    REQUIRE(at > 3e-6);
    if (first < 0.0) first = at;
    CHECK(at == Approx(first).epsilon(1e-7));
  });
  const Driven a = drive(*composite_of(with(true), cell), {stretch(3e-3, 3e3)}, 5),
               b = drive(*composite_of(with(false), cell), {stretch(3e-3, 3e3)}, 5);
  CHECK(distance(a.state.stress, b.state.stress) == 0.0);
}

TEST_CASE("without flow behind the plane a localised point stays elastic",
          "[material][decohesion][reading]") {
  const std::vector<Segment> path{stretch(3e-3, 3e3), {SymmetricTensor{-6e-3, -1e-3, 1e-3, 4e-3}, 1e-6}};
  with_every_method(glass_with([](MaterialParameters&) {}), path, 50, {},
                    [](const Driven& d) { CHECK(d.state.plastic_strain > 1e-4); });
  with_every_method(glass_with([](MaterialParameters& g) { g.decohesion->flow_behind_plane = false; }), path,
                    50, {}, [](const Driven& d) {
                      CHECK(is_localised(d.state));
                      CHECK(d.state.plastic_strain == 0.0);
                    });
}

TEST_CASE("rubble bears pressure once its void is closed, or nothing", "[material][decohesion][reading]") {
  MaterialParameters p = cohesive_glass(5.0e-6);
  Random random(92);
  for (const Separated bears : {Separated::pressure, Separated::nothing}) {
    p.decohesion->separated = bears;
    const double K = elastic_moduli(p.elastic).bulk;
    for (int sample = 0; sample < 20; ++sample) {
      const auto path = path_with_reversals(random, 2e-3, 1e4, 4);
      SymmetricTensor total{};
      double least_void = 0.0;  // of the volume, relative to touching faces
      for (const Segment& piece : path) {
        total += piece.strain;
        const double now = trace(total);
        least_void = std::min(least_void, now);
      }
      with_every_method(p, path, 3, separated_glass(p), [&](const Driven& d) {
        CHECK(d.dissipation.total() == 0.0);
        if (bears == Separated::nothing) {
          CHECK(norm(d.state.stress) == 0.0);
          CHECK(d.state.opening_n == Approx(cell * total.rr).margin(1e-15));
          CHECK(d.state.opening_t == Approx(2.0 * cell * total.rz).margin(1e-15));
        } else {
          CHECK(distance(d.state.stress, K * std::min(0.0, trace(total)) * identity()) < 1.0);
          CHECK(d.state.opening_n == Approx(cell * std::max(0.0, trace(total))).margin(1e-14));
        }
      });
    }
    // A point that separates loses what it stored, and books it.
    const MaterialParameters glass =
        glass_with([&](MaterialParameters& g) { g.decohesion->separated = bears; });
    with_every_method(glass, {stretch(8e-3, 3e3)}, 400, {}, [&](const Driven& d) {
      REQUIRE(is_separated(d.state));
      CHECK(norm(d.state.stress) < 1e-6);
      CHECK(d.work == Approx(d.dissipation.total()).epsilon(2e-2));
    });
  }
}

TEST_CASE("a point that is to be removed bears what dust does, and says so",
          "[material][decohesion][reading]") {
  MaterialParameters p = glass_with(
                         [](MaterialParameters&g) { g.decohesion->separated = Separated::nothing; }),
                     gone = p;
  gone.decohesion->separated = Separated::removed;
  CHECK(!composite_of(p, cell)->door().leaving_column());
  const std::optional<std::size_t> leaves = composite_of(gone, cell)->door().leaving_column();
  REQUIRE(leaves);
  CHECK(composite_of(gone, cell)->columns()[*leaves].name == "decohesion");
  Random random(31);
  std::vector<Segment> path = path_with_reversals(random, 8e-3, 1e4, 5);
  path.insert(path.begin(), stretch(8e-3, 3e3));
  std::vector<Driven> dust;
  with_every_method(p, path, 20, {}, [&](const Driven& d) { dust.push_back(d); });
  std::size_t n = 0;
  with_every_method(gone, path, 20, {}, [&](const Driven& d) {
    REQUIRE(is_separated(d.state));
    CHECK(d.state.opening_n == dust[n].state.opening_n);
    CHECK(d.dissipation.total() == dust[n++].dissipation.total());
    CHECK(norm(d.state.stress) == 0.0);
  });
}

TEST_CASE("rubble that bears shear keeps to q = beta P, and falls apart when it is let go",
          "[material][decohesion][reading]") {
  MaterialParameters p = cohesive_glass(5.0e-6);
  const double beta = 0.6, squeeze = 1e-3, shear = 2e-3;
  p.drucker_prager =
      DruckerPragerParameters{43.0e6, beta, true};  // neither its cohesion nor its dilation count
  p.decohesion->separated = Separated::drucker_prager;
  const Moduli m = elastic_moduli(p.elastic);
  const double P = 3.0 * m.bulk * squeeze, borne = beta * P / std::sqrt(3.0),
               yields = borne / (2.0 * m.shear);
  const Segment pressed{-squeeze * identity(), 1e-6}, sheared{{0.0, 0.0, 0.0, shear}, 1e-6},
      released{3.0 * squeeze * identity(), 1e-6};
  with_every_method(p, {pressed, sheared}, 1, separated_glass(p), [&](const Driven& d) {
    CHECK(d.state.stress.rz == Approx(borne).epsilon(1e-7));
    CHECK(trace(d.state.stress) == Approx(-3.0 * P).epsilon(1e-9));
    CHECK(d.dissipation.plastic == Approx(2.0 * borne * (shear - yields)).epsilon(1e-7));
    CHECK(d.state.plastic_strain == Approx(std::sqrt(2.0) * (shear - yields)).epsilon(1e-7));
  });
  with_every_method(p, {pressed, sheared, released}, 1, separated_glass(p), [&](const Driven& d) {
    CHECK(norm(d.state.stress) < 1.0);
    CHECK(d.dissipation.plastic == Approx(2.0 * borne * (shear - 0.5 * yields)).epsilon(1e-6));
    CHECK(d.state.opening_n == Approx(6.0 * squeeze * cell).epsilon(1e-9));
  });
  // Closed under more shear than the pressure bears, the stress rises along the surface.
  const SymmetricTensor oblique{-1e-3, 0.0, 0.0, 1.5e-3};
  const double asked = 2.0 * m.shear * std::sqrt(1.5) * norm(deviator(oblique)),
               part = beta * m.bulk * 1e-3 / asked;
  REQUIRE(part < 1.0);
  CompositeState loose = separated_glass(p);
  loose.opening_n = 2e-4 * cell;  // as much strain as a fifth of the path takes
  for (const int steps : {1, 64})
    with_every_method(p, {{oblique, 1e-6}}, steps, loose, [&](const Driven& d) {
      const SymmetricTensor expected =
          0.8 * (part * 2.0 * m.shear * deviator(oblique) - m.bulk * 1e-3 * identity());
      CHECK(distance(d.state.stress, expected) < 1e-6 * norm(expected));
      CHECK(d.count(EventKind::closure) == 1);
      CHECK(d.dissipation.plastic ==
            Approx(0.64 * m.shear * part * (1.0 - part) * contract(deviator(oblique), deviator(oblique)))
                .epsilon(steps > 1 ? 4e-2 : 1e-6));
    });
}

TEST_CASE("rubble dissipates as much in one increment as in many: closed from its apex, and let go",
          "[material][decohesion][reading][energy]") {
  MaterialParameters p = cohesive_glass(5.0e-6);
  p.drucker_prager = DruckerPragerParameters{43.0e6, 0.8, false};
  p.decohesion->separated = Separated::drucker_prager;
  const auto material = composite_of(p, cell);
  auto all = solvers(1e-9);
  Random random(31);
  int flowed = 0;
  for (int sample = 0; sample < 60; ++sample) {
    const SymmetricTensor shear = deviator(random.direction());
    CompositeState start = separated_glass(p);
    const bool closes = sample % 2 == 0;
    if (closes)
      start.opening_n = random.uniform(0.0, 1e-3) * cell;
    else
      start = drive(*material, {{-random.uniform(2e-4, 1e-3) * identity(), 1e-6}, {1e-4 * shear, 1e-6}}, 200,
                    start)
                  .state;
    const SymmetricTensor strain = (closes ? -1.0 : 1.0) * random.uniform(1e-3, 2e-3) * identity() +
                                   random.logarithmic(1e-4, 1e-2) * deviator(random.direction());
    const Driven once = drive(*material, {{strain, 1e-6}}, 1, start),
                 followed = drive(*material, {{strain, 1e-6}}, 1, start, all[0].integrator.get());
    CAPTURE(sample, closes);
    REQUIRE(followed.cause.empty());
    CHECK(distance(once.state.stress, followed.state.stress) < 1e3);
    CHECK(once.dissipation.plastic == Approx(followed.dissipation.plastic).epsilon(2e-3).margin(1.0));
    CHECK(once.state.plastic_strain == Approx(followed.state.plastic_strain).epsilon(2e-3).margin(1e-9));
    CHECK(once.state.opening_t == Approx(followed.state.opening_t).margin(1e-7 * cell));
    flowed += followed.dissipation.plastic > 100.0;
  }
  CHECK(flowed > 20);
}

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

TEST_CASE("the fall onto the pressure surface behind open faces is booked wherever increments end",
          "[material][decohesion][reading][energy]") {
  const MaterialParameters p = glass_with([](MaterialParameters& g) {
    g.decohesion = DecohesionParameters{5.0e-8, 1.0, 1.0, 0.0, false};
  });
  const auto material = composite_of(p, cell);
  const SymmetricTensor opened{0.003, 0.0, 0.0, -0.0008369370793948532},
      end{-0.0030104979409553536, 0.0022612264605000173, 0.00031525324679692956, 0.00041099320101293895};
  auto all = solvers(1e-8);
  for (int steps = 40; steps < 70; ++steps) {
    const Driven d =
        drive(*material, {{opened, 1e-6}, {end - opened, 1e-6}}, steps, {}, all[0].integrator.get());
    CAPTURE(steps);
    REQUIRE(d.cause.empty());
    CHECK(d.dissipation.total() == Approx(304.6e3).epsilon(2e-3));
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

TEST_CASE("what a separated point bears turns with it, and its energy is accounted for",
          "[material][decohesion][reading][energy]") {
  Random random(5);
  const auto turned = [](const SymmetricTensor& a, double angle) {  // components in axes turned by -angle
    const double mean = 0.5 * (a.rr + a.zz), half = 0.5 * (a.rr - a.zz), c = std::cos(2.0 * angle),
                 s = std::sin(2.0 * angle);
    return SymmetricTensor{mean + half * c - a.rz * s, mean - half * c + a.rz * s, a.tt, half * s + a.rz * c};
  };
  for (const NamedMaterial& reading : readings()) {
    const DecohesionParameters& decohesion = *reading.parameters.decohesion;
    if (decohesion.separated == Separated::faces && decohesion.friction == 0.0) continue;
    const auto material = composite_of(reading.parameters, cell);
    CAPTURE(reading.name);
    double residual = 0.0, stored = 0.0;
    for (int sample = 0; sample < 10; ++sample) {
      const double angle = random.uniform(-1.5, 1.5);
      const auto path = path_with_reversals(random, 3e-3, 1e4, 5);
      auto other = path;
      for (Segment& piece : other) piece.strain = turned(piece.strain, angle);
      CompositeState here = at_onset(*material, 0.0, 50.0e6, {}),
                     there = at_onset(*material, angle, 50.0e6, {});
      here.decohesion = there.decohesion = 1.0;
      const auto check = [&](int steps, PointIntegrator* method) {
        const Driven a = drive(*material, path, steps, here, method),
                     b = drive(*material, other, steps, there, method);
        CAPTURE(a.cause, b.cause);
        REQUIRE((a.cause + b.cause).empty());
        CHECK(distance(turned(a.state.stress, angle), b.state.stress) < 1e3);
        CHECK(a.dissipation.total() == Approx(b.dissipation.total()).epsilon(1e-5).margin(1e-3));
        CHECK(a.least_dissipation >= -1e-9 * (1.0 + a.dissipation.total()));
        return a;
      };
      for (LocalSolver& solver : solvers(1e-9)) {
        CAPTURE(solver.name, sample);
        check(2, solver.integrator.get());
      }
      const Driven fine = check(2000, nullptr);
      const double now = material->stored_energy(fine.state);
      residual += std::abs(fine.work - fine.dissipation.total() - now);
      stored += now + fine.dissipation.total();
    }
    CAPTURE(residual, stored);
    CHECK(residual <= 2e-3 * stored);
  }
}

TEST_CASE("what a separated point bears at the ends of what its keys admit",
          "[material][decohesion][reading][extreme]") {
  Random random(23);
  for (const double extreme : {1e-6, 1e-2, 1.0, 100.0})
    for (const bool rubble : {false, true}) {
      MaterialParameters p = glass_with([&](MaterialParameters& g) {
        g.decohesion->separated = rubble ? Separated::drucker_prager : Separated::faces;
        g.decohesion->friction = rubble ? 0.0 : extreme;
        g.drucker_prager->beta = rubble ? extreme : 1.8;
      });
      for (const double size : {1e-12, 1e-3, 0.3}) {
        const auto path = path_with_reversals(random, size, 1e4, 6);
        CAPTURE(extreme, rubble, size);
        with_every_method(p, path, 2, separated_glass(p), [&](const Driven& d) {
          CHECK(is_finite(d.state));
          CHECK(d.least_dissipation >= 0.0);
        });
      }
    }
}

TEST_CASE("solvers agree on random paths whatever the reading, and the closed form approaches them",
          "[material][decohesion][reading][local]") {
  for (const NamedMaterial& reading : readings()) {
    const auto material = composite_of(reading.parameters, cell);
    const double scale = 1e-3 * elastic_moduli(reading.parameters.elastic).p_wave();
    Random random(8);
    double coarse = 0.0, fine = 0.0;
    for (int i = 0; i < 12; ++i) {
      const auto path = path_with_reversals(random, 3e-3, random.logarithmic(1e2, 1e4), 5);
      auto all = solvers(1e-8);
      const Driven substep = drive(*material, path, 2, {}, all[0].integrator.get()),
                   bdf = drive(*material, path, 2, {}, all[1].integrator.get());
      CAPTURE(reading.name, i);
      REQUIRE(substep.cause.empty());
      REQUIRE(bdf.cause.empty());
      REQUIRE(distance(substep.state.stress, bdf.state.stress) < 1e-5 * scale);
      REQUIRE(is_finite(bdf.state));
      coarse += distance(drive(*material, path, 50).state.stress, bdf.state.stress) / scale;
      fine += distance(drive(*material, path, 800).state.stress, bdf.state.stress) / scale;
    }
    CAPTURE(reading.name, coarse, fine);
    CHECK(fine <= coarse / 8.0 + 1e-6);
  }
}

TEST_CASE("looking for a localisation that compression forbids takes no longer than another",
          "[material][decohesion][reading]") {
  // Damage grows far beyond the bifurcation while a stress stays compressive: 20,000 increments, each of
  // which would be halved a million times without a bound.
  const MaterialParameters p =
      glass_with([](MaterialParameters& g) { g.decohesion->partial_compression = false; });
  const Driven d = drive(*composite_of(p, cell), {{{4e-3, -1.6e-3, -1.6e-3, 2e-4}, 5e-6}}, 20000);
  CHECK(!is_localised(d.state));
  CHECK(d.state.crack_density > 0.1);
}
