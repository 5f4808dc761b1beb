// Separated points that leave the computation (decohesion.separated = "removed"): what goes with them is
// booked, what stays does not feel them any more.
#include "mpm/removal.hpp"

#include <cmath>
#include <map>
#include <numeric>

#include "catch.hpp"
#include "mpm/point.hpp"
#include "support/contact_scenes.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double cell = 0.5e-3, left_end = -3e-3, right_end = 5e-3;

/// A bar in uniaxial strain that is pulled apart, elastic but for a cell of glass in it.
MpmScene weak_bar(const Integrator& integrator, const std::string& separated = "removed") {
  MpmScene scene;
  scene.cell = cell, scene.density = 2500.0, scene.young = 72e9, scene.poisson = 0.25;
  integrator.choose(scene);
  scene.pace = (scene.method == "explicit" ? "step = " : "fixed_step = ") + number(1e-8);
  const std::string more = "particles_per_cell = 4\nvelocity_gradient = [[9000, 0], [0, 0]]";
  std::string middle = body("weak", box({0.0, 0.0}, {cell, cell}), more);
  middle.replace(middle.find("elastic"), 7, "glass");
  scene.tables = "[contact]\nmethod = \"single\"\n" + hold_everywhere("y") +
                 body("left", box({left_end, 0.0}, {0.0, cell}), more) + middle +
                 body("right", box({cell, 0.0}, {right_end, cell}), more) +
                 "[material.glass]\ndensity = 2500\nyoung = 72e9\npoisson = 0.25\n"
                 "[material.glass.damage]\ntoughness = 0.83e6\nk = 5e26\nm = 6\nrate = {fixed = 1e4}\n"
                 "[material.glass.decohesion]\nopening = 1e-6\nq = 1\nmode_ratio = 50\nseparated = \"" +
                 separated + "\"\n";
  return scene;
}

/// Adds up what has left over the steps of a run.
struct Left {
  std::array<double, 2> momentum{};
  double mass = 0.0, kinetic = 0.0;
  std::size_t particles = 0, separations = 0;

  void watch(MpmRun& run) {
    run.watch = [this, &run](double) {
      for (const BodyEvent& e : run.system.record.events)
        if (e.event.kind == EventKind::separation) ++separations;
      for (const RemovedParticle& r : run.system.record.left) {
        for (std::size_t c = 0; c < 2; ++c) momentum[c] += r.mass * r.velocity[c];
        kinetic += 0.5 * r.mass * (r.velocity[0] * r.velocity[0] + r.velocity[1] * r.velocity[1]);
        mass += r.mass, ++particles;
      }
      return true;
    };
  }
};

double momentum_of(const Body& body) {
  return std::transform_reduce(body.particles.mass.begin(), body.particles.mass.end(),
                               body.particles.velocity[0].begin(), 0.0);
}

/// All that particles keep, by body and identity.
std::vector<double> bits_of(const System& system) {
  std::vector<double> bits;
  for (const Body& body : system.bodies) {
    std::map<std::uint32_t, std::size_t> places;
    for (std::size_t i = 0; i < body.particles.size; ++i) places[body.particles.identity[i]] = i;
    for (const auto& [identity, i] : places)
      mpm::for_each_column(body.particles, [&, place = i](const auto& column) {
        if (!column.empty()) bits.push_back(static_cast<double>(column[place]));
      });
  }
  return bits;
}

}  // namespace

TEST_CASE("A bar whose middle is removed flies in two halves, and what is gone is booked",
          "[verification][mpm][reading][removed]") {
  for (const Integrator& integrator : five_integrators) {
    CAPTURE(integrator.name);
    const bool adapts = integrator.name.starts_with("arkode");
    MpmRun run(weak_bar(integrator));
    const double before = total_momentum(run.system)[0];
    Left left;
    left.watch(run);
    REQUIRE(run.advance(2e-6));
    const Body& weak = run.system.bodies[1];
    REQUIRE(weak.removed == weak.particles.size);
    CHECK(left.particles == weak.removed);
    CHECK(left.separations == weak.removed);
    CHECK(left.mass == Approx(mpm::removed_mass(weak)).epsilon(1e-14));
    CHECK(run.energy().removed == Approx(left.kinetic).epsilon(1e-12));
    CHECK(left.kinetic > 0.0);
    const double after = total_momentum(run.system)[0];
    CHECK(after + left.momentum[0] == Approx(before).epsilon(adapts ? 1e-7 : 1e-11));
    // As with points that bear nothing and stay: USL loses by its scheme.
    CHECK(std::abs(run.energy().relative_residual()) < (integrator.name == "usl" ? 0.3 : 0.03));
    const VectorColumns where = weak.particles.position;
    const std::array halves{momentum_of(run.system.bodies[0]), momentum_of(run.system.bodies[2])};
    const double residual = run.energy().residual(), gone = run.energy().removed;
    REQUIRE(run.advance(4e-6));
    CHECK(weak.particles.position == where);
    for (std::size_t i = 0; i < weak.particles.size; ++i) {
      CHECK(weak.particles.velocity[0][i] == 0.0);
      CHECK(norm(mpm::point_of(weak, i).stress) == 0.0);
    }
    CHECK(momentum_of(run.system.bodies[0]) == Approx(halves[0]).epsilon(adapts ? 1e-7 : 1e-11));
    CHECK(momentum_of(run.system.bodies[2]) == Approx(halves[1]).epsilon(adapts ? 1e-7 : 1e-11));
    CHECK(run.energy().removed == gone);
    if (integrator.name != "usl")
      CHECK(std::abs(run.energy().residual() - residual) < 0.03 * run.energy().scale());
    CHECK(left.particles == weak.particles.size);
  }
}

TEST_CASE("Points that bear nothing and stay hold the halves back, those that are removed do not",
          "[verification][mpm][reading][removed]") {
  const auto apart = [](const std::string& separated) {
    MpmRun run(weak_bar({"musl"}, separated));
    REQUIRE(run.advance(4e-6));
    return mean_velocity(run, 2) - mean_velocity(run, 0);
  };
  CHECK(apart("removed") > apart("nothing"));
}

TEST_CASE("Removal has the same bits for any number of threads", "[verification][mpm][reading][removed]") {
  for (const Integrator& integrator : five_integrators) {
    CAPTURE(integrator.name);
    MpmRun one(weak_bar(integrator), 1), three(weak_bar(integrator), 3);
    REQUIRE(one.advance(2e-6));
    REQUIRE(three.advance(2e-6));
    REQUIRE(one.system.bodies[1].removed > 0);
    CHECK(bits_of(one.system) == bits_of(three.system));
    CHECK(one.energy().residual() == three.energy().residual());
  }
}

TEST_CASE("Surfaces go with the particles that carry them, and what contact stored there is booked",
          "[verification][mpm][contact][reading][removed]") {
  for (const Integrator& integrator : five_integrators) {
    CAPTURE(integrator.name);
    const bool adapts = integrator.name.starts_with("arkode");
    MpmScene scene = bars(0.0, 5.0, -10.0, "friction = 0.3\n");
    integrator.choose(scene);
    scene.tables +=
        "[material.elastic.decohesion]\nopening = 1e-6\nq = 1\nmode_ratio = 1\nseparated = \"removed\"\n";
    MpmRun run(scene);
    REQUIRE(run.advance(1e-6));
    REQUIRE(run.system.record.contact > 0.0);
    // The first two rows of b separate, as if they had stored nothing.
    Body& b = run.system.bodies[1];
    const auto column = [&](const char* name) -> std::vector<double>& {
      return b.particles.variables[b.material->column(name).value()];
    };
    std::size_t rows = 0;
    for (std::size_t i = 0; i < b.particles.size; ++i) {
      if (!(b.particles.position[0][i] < 0.5e-3)) continue;
      ++rows;
      column("decohesion")[i] = 1.0, column("normal_r")[i] = 1.0, column("effective_length")[i] = 0.5e-3;
      column("cohesive_strength")[i] = 1e6;
      for (auto& strain : b.particles.elastic_strain) strain[i] = 0.0;
    }
    REQUIRE(rows == 8);
    run.reopen_ledger();
    const std::array before = total_momentum(run.system);
    Left left;
    left.watch(run);
    REQUIRE(run.advance(2e-6));
    CHECK(b.removed == rows);
    CHECK(run.system.record.contact == 0.0);  // nothing of b is where a could touch it
    // What a phase removes has been pushed out of the contact by its end.
    if (integrator.name != "arkode-implicit") CHECK(run.energy().removed > left.kinetic);
    const std::array after = total_momentum(run.system);
    CHECK(after[0] + left.momentum[0] == Approx(before[0]).epsilon(adapts ? 1e-6 : 1e-11));
    CHECK(std::abs(run.energy().relative_residual()) < (integrator.name == "usl" ? 0.2 : 0.05));
  }
}
