// What the paper leaves open after eq. 7: each reading against its closed form, every local method against
// the others, and the account.
#include "support/reading_paths.hpp"

using namespace vitrum;
using namespace vitrum::test;

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
