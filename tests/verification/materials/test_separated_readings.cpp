// What a separated point bears: rubble, faces that rub, dust, or nothing as it is removed. Each against
// closed forms or a brute-force reference, every local method against the others, and the account.
#include "support/reading_paths.hpp"

using namespace vitrum;
using namespace vitrum::test;

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
