// What must hold of every law behind the door, whoever wrote it: what it answers to strain.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "catch.hpp"
#include "support/law_samples.hpp"
#include "support/local_solvers.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

struct Ends {
  PointState state;
  double work = 0.0, dissipated = 0.0, least = 0.0;
};
/// Follows a path of straight pieces in `steps` increments each. Work by the trapezoidal rule, J/m^3.
Ends follow(const LawSample& law, const std::vector<SymmetricTensor>& pieces, int steps,
            PointIntegrator* integrator = nullptr) {
  Ends ends{law.start()};
  for (const SymmetricTensor& piece : pieces)
    for (int i = 0; i < steps; ++i) {
      const SymmetricTensor increment = (1.0 / steps) * piece, before = ends.state.stress;
      const double duration = norm(increment) / law.rate;
      PointReport report;
      if (integrator != nullptr)
        integrator->integrate(*law.material, ends.state, increment, duration, report);
      else
        law.material->advance(ends.state, increment, duration, report);
      REQUIRE(report.cause == "");
      ends.work += contract(0.5 * (before + ends.state.stress), increment);
      ends.dissipated += report.dissipation.total();
      ends.least = std::min(ends.least, report.dissipation.total());
    }
  return ends;
}
std::vector<SymmetricTensor> random_pieces(Random& random, const LawSample& law, int count) {
  std::vector<SymmetricTensor> pieces;
  for (int i = 0; i < count; ++i)
    pieces.push_back(law.strain * random.uniform(0.3, 1.0) * random.direction());
  return pieces;
}

bool is_finite(const SymmetricTensor& a) {
  return std::isfinite(a.rr + a.zz + a.tt + a.rz);
}

}  // namespace

TEST_CASE("where nothing dissipates the stress is the derivative of the stored energy",
          "[material][conformance][energy]") {
  for (const LawSample& law : law_samples()) {
    CAPTURE(law.name);
    Random random(213);
    const Material& material = *law.material;
    int tried = 0;
    for (int sample = 0; sample < 100; ++sample) {
      const PointState at = follow(law, random_pieces(random, law, 2), 4).state;
      const SymmetricTensor step = 1e-5 * law.strain * random.direction();
      PointState ahead = at, behind = at;
      PointReport report;
      // In no time, in which viscous laws do nothing.
      material.advance(ahead, step, 0.0, report);
      material.advance(behind, -1.0 * step, 0.0, report);
      if (report.dissipation.total() != 0.0) continue;
      ++tried;
      const double change = material.stored_energy(ahead) - material.stored_energy(behind);
      const double stiffness = material.density() * material.wave_speed() * material.wave_speed();
      REQUIRE(change == Approx(contract(ahead.stress + behind.stress, step))
                            .margin(1e-6 * stiffness * law.strain * norm(step)));
    }
    CHECK(tried >= 10);
  }
}

TEST_CASE("work is what is stored and dissipated, and dissipation is never negative",
          "[material][conformance][energy]") {
  for (const LawSample& law : law_samples()) {
    CAPTURE(law.name);
    Random random(214);
    double coarse = 0.0, fine = 0.0, scale = 0.0;
    for (int sample = 0; sample < 20; ++sample) {
      const auto pieces = random_pieces(random, law, 3);
      const auto lost = [&](int steps) {
        const Ends e = follow(law, pieces, steps);
        REQUIRE(e.least >= -1e-12 * (e.dissipated + e.work));
        scale += std::abs(e.work);
        return std::abs(e.work - law.material->stored_energy(e.state) - e.dissipated);
      };
      coarse += lost(16), fine += lost(256);
    }
    CAPTURE(coarse, fine, scale);
    // First order of the trapezoidal rule at kinks and of implicit returns.
    CHECK(fine <= 0.15 * coarse + 1e-9 * scale);
    CHECK(fine <= 0.01 * scale);
  }
}

TEST_CASE("shorter increments approach one result", "[material][conformance]") {
  for (const LawSample& law : law_samples()) {
    CAPTURE(law.name);
    Random random(215);
    double coarse = 0.0, fine = 0.0, scale = 0.0;
    for (int sample = 0; sample < 20; ++sample) {
      const auto pieces = random_pieces(random, law, 3);
      const SymmetricTensor limit = follow(law, pieces, 512).state.stress;
      coarse += norm(follow(law, pieces, 4).state.stress - limit);
      fine += norm(follow(law, pieces, 32).state.stress - limit);
      scale += norm(limit);
    }
    CAPTURE(coarse, fine, scale);
    CHECK(fine <= 0.25 * coarse + 1e-9 * scale);
    CHECK(fine <= 0.05 * scale);
  }
}

TEST_CASE("the tangent is the slope of the response", "[material][conformance]") {
  for (const LawSample& law : law_samples()) {
    CAPTURE(law.name);
    Random random(216);
    const Material& material = *law.material;
    int compared = 0;
    for (int sample = 0; sample < 100; ++sample) {
      const PointState at = follow(law, random_pieces(random, law, 2), 4).state;
      const SymmetricTensor increment = 0.1 * law.strain * random.direction(), direction = random.direction();
      const double duration = norm(increment) / law.rate, h = 1e-5 * law.strain;
      const auto stress_at = [&](double f) {
        PointState s = at;
        PointReport report;
        material.advance(s, increment + f * direction, duration, report);
        return s.stress;
      };
      const SymmetricTensor ahead = stress_at(h) - stress_at(0.0), behind = stress_at(0.0) - stress_at(-h);
      const double stiffness = material.density() * material.wave_speed() * material.wave_speed();
      if (norm(ahead - behind) > 1e-3 * stiffness * h) continue;  // a kink within the stencil
      const TangentEntries T = material.tangent(at, increment, duration);
      const std::array<double, 4> d{direction.rr, direction.zz, direction.tt, direction.rz};
      std::array<double, 4> slope{};
      for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t c = 0; c < 4; ++c) slope[row] += T[4 * row + c] * d[c];
      const SymmetricTensor found{slope[0], slope[1], slope[2], slope[3]};
      REQUIRE(norm(found - (0.5 / h) * (ahead + behind)) <= 2e-3 * stiffness);
      ++compared;
    }
    CHECK(compared >= 50);
  }
}

TEST_CASE("stress of columns, of a point, and of an increment that is tried are one",
          "[material][conformance]") {
  for (const LawSample& law : law_samples()) {
    CAPTURE(law.name);
    Random random(218);
    const Material& material = *law.material;
    for (int sample = 0; sample < 20; ++sample) {
      const PointState s = follow(law, random_pieces(random, law, 3), 4).state;
      double stress[4];
      VariableColumns<const double*> variables;
      variables.resize(material.columns().size());
      for (std::size_t k = 0; k < variables.size(); ++k) variables[k] = nullptr;
      std::vector<double> values(material.columns().size());
      for (const std::size_t k : material.stress_columns())
        values[k] = value_of(material, s, k), variables[k] = &values[k];
      const SymmetricTensor& e = s.elastic_strain;
      material.stress({&e.rr, &e.zz, &e.tt, &e.rz}, variables, 1,
                      {&stress[0], &stress[1], &stress[2], &stress[3]});
      const SymmetricTensor of_columns{stress[0], stress[1], stress[2], stress[3]};
      REQUIRE(norm(of_columns - s.stress) <= 1e-12 * (norm(s.stress) + 1.0));
      REQUIRE(norm(material.stress(s) - s.stress) <= 1e-12 * (norm(s.stress) + 1.0));
    }
  }
}

TEST_CASE("no increment in no time changes nothing, and what is not a number shows",
          "[material][conformance]") {
  for (const LawSample& law : law_samples()) {
    CAPTURE(law.name);
    Random random(219);
    for (int sample = 0; sample < 20; ++sample) {
      const PointState s = follow(law, random_pieces(random, law, 3), 4).state;
      PointState same = s;
      PointReport report;
      law.material->advance(same, {}, 0.0, report);
      REQUIRE(norm(same.stress - s.stress) <= 1e-9 * norm(s.stress));
      REQUIRE(report.dissipation.total() <= 1e-9 * (s.dissipated + 1.0));
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      for (const SymmetricTensor& bad :
           {SymmetricTensor{nan, 0.0, 0.0, 0.0}, SymmetricTensor{0.0, 0.0, 0.0, nan},
            SymmetricTensor{nan, nan, nan, nan}}) {
        PointState wrong = s;
        report.clear();
        law.material->advance(wrong, bad, 1e-7, report);
        REQUIRE((report.failed() || !is_finite(wrong.stress)));
      }
    }
  }
}

TEST_CASE("the closed form is what the solvers of the law's ODE approach", "[material][conformance]") {
  int compared = 0;
  for (const LawSample& law : law_samples()) {
    if (law.material->event_driven() == nullptr) continue;
    CAPTURE(law.name);
    Random random(220);
    for (int sample = 0; sample < 5; ++sample) {
      const auto pieces = random_pieces(random, law, 2);
      const SymmetricTensor closed = follow(law, pieces, 400).state.stress;
      for (const LocalSolver& solver : solvers(1e-7)) {
        CAPTURE(solver.name, sample);
        const SymmetricTensor solved = follow(law, pieces, 10, solver.integrator.get()).state.stress;
        REQUIRE(norm(solved - closed) <= 0.02 * norm(closed));
        ++compared;
      }
    }
  }
  CHECK(compared > 0);
}
