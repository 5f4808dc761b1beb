#include <algorithm>
#include <array>

#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// Columns for `count` particles; those of variables the material lacks stay null.
struct Columns {
  using Tensors = TensorColumns;
  Tensors elastic_strain, stress, increment;
  std::vector<std::vector<double>> variables;
  std::vector<std::string> names;
  std::vector<double> spin, mass;
  ParticleColumns pointers;

  Columns(const CompositeMaterial& material, std::size_t count) : spin(count, 0.0), mass(count, 1.0) {
    for (std::size_t c = 0; c < 4; ++c) {
      elastic_strain[c].assign(count, 0.0), stress[c].assign(count, 0.0), increment[c].assign(count, 0.0);
      pointers.start_strain[c] = pointers.elastic_strain[c] = elastic_strain[c].data();
      pointers.stress[c] = stress[c].data();
      pointers.strain_increment[c] = increment[c].data();
    }
    variables.assign(material.columns().size(), std::vector<double>(count, 0.0));
    for (std::size_t k = 0; k < variables.size(); ++k) {
      names.push_back(material.columns()[k].name);
      pointers.start_variables.push_back(variables[k].data());
      pointers.variables.push_back(variables[k].data());
    }
    pointers.spin_increment = spin.data();
    pointers.mass = mass.data();
  }

  void set_increment(std::size_t i, const SymmetricTensor& e) {
    increment[0][i] = e.rr, increment[1][i] = e.zz, increment[2][i] = e.tt, increment[3][i] = e.rz;
  }
  SymmetricTensor stress_of(std::size_t i) const {
    return {stress[0][i], stress[1][i], stress[2][i], stress[3][i]};
  }
  /// Stress that the material finds for the state as it stands.
  Tensors stress_of_state(const CompositeMaterial& material) const {
    Tensors found;
    TensorPointers<double> to{};
    for (std::size_t c = 0; c < 4; ++c) found[c].resize(mass.size()), to[c] = found[c].data();
    material.door().stress(pointers.start_strain, pointers.start_variables, mass.size(), to);
    return found;
  }
  SymmetricTensor strain_of(std::size_t i) const {
    return {elastic_strain[0][i], elastic_strain[1][i], elastic_strain[2][i], elastic_strain[3][i]};
  }
  double of(std::size_t i, std::string_view name) const {
    return variables[static_cast<std::size_t>(std::ranges::find(names, name) - names.begin())][i];
  }
};

}  // namespace

TEST_CASE("the batch response without spin is the response of its points", "[material][batch]") {
  constexpr std::size_t count = 40;
  for (const NamedMaterial& named : all_compositions()) {
    CAPTURE(named.name);
    const auto material = composite_of(named.parameters, cell);
    Columns columns(*material, count);
    std::vector<CompositeState> points(count);
    Random random(120);
    for (double& m : columns.mass) m = random.uniform(0.5, 2.0);
    Dissipation expected;
    BatchReport report;
    for (int step = 0; step < 20; ++step) {
      std::vector<ParticleEvent> events;
      double stored = 0.0;
      report.events.clear();
      report.elastic = 0.0;
      // Particles outside [begin, end) must stay as they are.
      const std::size_t begin = 3, end = count - 2;
      for (std::size_t i = 0; i < count; ++i) {
        const SymmetricTensor e = random.tensor(1e-3);
        columns.set_increment(i, e);
        if (i < begin || i >= end) continue;
        PointReport point;
        material->respond(points[i], e, 1e-7, point);
        const double volume = columns.mass[i] / 2500.0;
        expected.plastic += volume * point.dissipation.plastic;
        expected.damage += volume * point.dissipation.damage;
        expected.fracture += volume * point.dissipation.fracture;
        expected.snap_back += volume * point.dissipation.snap_back;
        stored += columns.mass[i] / 2500.0 * material->stored_energy(points[i]);
        for (std::size_t k = 0; k < point.events.size(); ++k) events.push_back({i, point.events[k]});
      }
      material->respond(columns.pointers, begin, end, 1e-7, nullptr, report);
      const Columns::Tensors stress = columns.stress_of_state(*material);
      for (std::size_t i = 0; i < count; ++i) {
        REQUIRE(distance(columns.stress_of(i), points[i].stress) <= 1e-12 * norm(points[i].stress));
        const SymmetricTensor of_state{stress[0][i], stress[1][i], stress[2][i], stress[3][i]};
        REQUIRE(distance(of_state, points[i].stress) <= 1e-12 * norm(points[i].stress));
        REQUIRE(columns.strain_of(i) == points[i].elastic_strain);
        for (const Component& c : material->columns())
          REQUIRE(columns.of(i, c.name) == number(points[i], c.name));
      }
      REQUIRE(report.elastic == Approx(stored).epsilon(1e-12));
      REQUIRE(report.events.size() == events.size());
      for (std::size_t k = 0; k < events.size(); ++k) {
        REQUIRE(report.events[k].particle == events[k].particle);
        REQUIRE(report.events[k].event.kind == events[k].event.kind);
        REQUIRE(report.events[k].event.fraction == events[k].event.fraction);
      }
    }
    CHECK(report.dissipated.plastic == Approx(expected.plastic).epsilon(1e-12));
    CHECK(report.dissipated.damage == Approx(expected.damage).epsilon(1e-12));
    CHECK(report.dissipated.fracture == Approx(expected.fracture).epsilon(1e-12));
    CHECK(report.dissipated.snap_back == Approx(expected.snap_back).epsilon(1e-12));
  }
}

TEST_CASE(
    "the stored energy of a batch is the work on the reference volume, at strains of any size and order",
    "[material][batch][energy]") {
  const auto glass = composite_of(bare_glass(), cell);
  Columns columns(*glass, 1);
  columns.mass[0] = 2500.0;  // 1 m^3
  // A path through strains of order one whose volume and shape change together: the work V0 sigma : de is
  // integrated by the mid-point rule, exact for a quadratic potential.
  double work = 0.0;
  BatchReport report;
  const auto load = [&](const SymmetricTensor& e) {
    constexpr int steps = 2000;
    columns.set_increment(0, (1.0 / steps) * e);
    for (int i = 0; i < steps; ++i) {
      const SymmetricTensor before = columns.stress_of(0);
      report = {};
      glass->respond(columns.pointers, 0, 1, 1e-9, nullptr, report);
      work += contract(0.5 * (before + columns.stress_of(0)), (1.0 / steps) * e);
    }
  };
  load(-1.5 * identity());
  load({0.3, -0.2, 0.4, 0.2});
  load({0.9, 1.1, 0.7, -0.3});
  CHECK(report.elastic == Approx(work).epsilon(1e-10));
  CHECK(report.elastic > 0.0);
}

TEST_CASE("a spin turns stress, strain and normal and leaves the rest", "[material][batch][objectivity]") {
  Random random(121);
  int turned_planes = 0;
  for (const NamedMaterial& named : all_compositions()) {
    CAPTURE(named.name);
    const auto material = composite_of(named.parameters, cell);
    Columns still(*material, 1), turning(*material, 1);
    BatchReport a, b;
    double angle = 0.0;
    for (int step = 0; step < 60; ++step) {
      // The increment is given in the corotating frame at the start of the step: turned by what has
      // accumulated.
      // A stretch that localises wherever the composition can, then anything.
      const SymmetricTensor e =
          step < 20 ? SymmetricTensor{4e-4, 0.0, 1e-4, 2e-4} : random.tensor(3e-4) + 5e-5 * identity();
      const Rotation turned{std::cos(angle), std::sin(angle)};
      // The effective length is that of the plane in the grid at onset: keep the frames aligned until then.
      const bool localised = named.parameters.decohesion && still.of(0, "effective_length") > 0.0;
      const bool may_turn = !named.parameters.decohesion || localised;
      const double spin = may_turn ? random.uniform(-0.5, 0.5) : 0.0;
      still.set_increment(0, e);
      turning.set_increment(0, rotate(e, turned));
      turning.spin[0] = spin;
      material->respond(still.pointers, 0, 1, 1e-7, nullptr, a);
      material->respond(turning.pointers, 0, 1, 1e-7, nullptr, b);
      angle += spin;
      const Rotation now{std::cos(angle), std::sin(angle)};
      const double scale = norm(still.stress_of(0)) + 1e3;
      REQUIRE(distance(rotate(still.stress_of(0), now), turning.stress_of(0)) < 1e-8 * scale);
      for (const Component& c : material->columns()) {
        if (c.name == "normal_r" || c.name == "normal_z") continue;
        CAPTURE(c.name);
        REQUIRE(turning.of(0, c.name) == Approx(still.of(0, c.name)).epsilon(1e-8).margin(1e-9 * c.scale));
      }
      if (localised) {
        ++turned_planes;
        const double r = still.of(0, "normal_r"), z = still.of(0, "normal_z");
        REQUIRE(turning.of(0, "normal_r") == Approx(now.cosine * r - now.sine * z).margin(1e-12));
        REQUIRE(turning.of(0, "normal_z") == Approx(now.sine * r + now.cosine * z).margin(1e-12));
      }
    }
    REQUIRE(a.elastic == Approx(b.elastic).epsilon(1e-8));
  }
  CHECK(turned_planes > 150);
}
