#include "integrators/sundials/ark_solver.hpp"

#include <cmath>
#include <stdexcept>

#include "catch.hpp"
#include "support/mpm_measure.hpp"

using namespace vitrum::sundials;
using vitrum::test::order;

namespace {

/// Two pendulums: u'' = -k sin u, with Newton's equations reduced to a 2 x 2 matrix like those of the grid.
class Pendulums final : public ReducibleSystem {
 public:
  explicit Pendulums(double tolerance = 1e-3) : tolerance_(tolerance) { pattern_ = {{0, 1, 2}, {0, 1}}; }
  std::size_t size() const override { return 4; }
  bool rates(double t, const double* y, double* f) override {
    ++evaluations;
    if (t > forbidden_from) return false;
    if (throws_from >= 0.0 && t > throws_from) throw std::runtime_error("no further");
    for (std::size_t i = 0; i < 2; ++i) f[i] = y[2 + i], f[2 + i] = -stiffness[i] * std::sin(y[i]);
    return true;
  }
  void error_weights(double* w) const override { std::fill(w, w + 4, 1.0 / tolerance_); }
  double stable_step(double, const double*) override { return stable; }
  const SparsePattern& pattern() const override { return pattern_; }
  bool linearise(double, const double* y) override {
    for (std::size_t i = 0; i < 2; ++i) slope_[i] = stiffness[i] * std::cos(y[i]);
    return true;
  }
  void form(double gamma, double* values) const override {
    for (std::size_t i = 0; i < 2; ++i) values[i] = 1.0 + gamma * gamma * slope_[i];
  }
  void reduce(double gamma, const double* b, double* c) const override {
    for (std::size_t i = 0; i < 2; ++i) c[i] = b[2 + i] - gamma * slope_[i] * b[i];
  }
  void expand(double gamma, const double* b, const double* z, double* x) const override {
    for (std::size_t i = 0; i < 2; ++i) x[i] = b[i] + gamma * z[i], x[2 + i] = z[i];
  }

  std::array<double, 2> stiffness{1.0, 4.0};
  double stable = std::numeric_limits<double>::infinity();
  double forbidden_from = std::numeric_limits<double>::infinity(), throws_from = -1.0;
  int evaluations = 0;

 private:
  double tolerance_;
  SparsePattern pattern_;
  std::array<double, 2> slope_{};
};

ButcherTable table(TableKind kind, int of_order) {
  return *find_table(kind, table_of_order(kind, of_order));
}

std::unique_ptr<ArkSolver> solver(const Context& context, const ButcherTable& t, const ArkSettings& settings,
                                  Pendulums& system, LinearSolverKind linear = LinearSolverKind::klu) {
  auto made = t.kind == TableKind::explicit_stages
                  ? std::make_unique<ArkSolver>(context, t, settings, static_cast<ArkSystem&>(system))
                  : std::make_unique<ArkSolver>(context, t, settings, system, linear);
  made->y()[0] = 1.0, made->y()[1] = 0.5;
  return made;
}

/// State after two seconds.
std::array<double, 4> after(ArkSolver& s, double first_step) {
  s.start(0.0, first_step);
  double t = 0.0;
  while (t < 2.0) {
    const auto step = s.step(2.0);
    REQUIRE(step.failure == ArkSolver::Failure::none);
    t = step.time;
  }
  REQUIRE(t == 2.0);
  return {s.y()[0], s.y()[1], s.y()[2], s.y()[3]};
}

double difference(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

std::array<double, 4> exact(const Context& context) {
  Pendulums system;
  ArkSettings settings;
  settings.fixed_step = 2e-3;
  const auto t = *find_table(TableKind::explicit_stages, "ARKODE_FEHLBERG_13_7_8");
  return after(*solver(context, t, settings, system), 2e-3);
}

}  // namespace

TEST_CASE("Every table shows its order with a fixed step", "[integrators][sundials]") {
  const Context context;
  const auto reference = exact(context);
  for (const TableKind kind : {TableKind::explicit_stages, TableKind::diagonally_implicit})
    for (const std::string& name : table_names(kind)) {
      const ButcherTable t = *find_table(kind, name);
      if (t.order > 5) continue;
      const auto error = [&](double step) {
        Pendulums system(1e-12);
        ArkSettings settings;
        settings.fixed_step = step;
        settings.newton_iterations = 20;
        return difference(after(*solver(context, t, settings, system), step), reference);
      };
      const double step = t.order <= 3 ? 0.02 : 0.1;
      const double coarse = error(step), fine = error(0.5 * step), measured = order(coarse, fine);
      CAPTURE(name, coarse, fine, measured);
      // Tables that SUNDIALS lists with a lower order may do better on this system; none may do worse.
      CHECK(measured > t.order - 0.2);
      CHECK(measured < t.order + 1.2);
    }
}

TEST_CASE("Adaptive steps keep the tolerance, meet the stop and are limited by what is said",
          "[integrators][sundials]") {
  const Context context;
  const auto reference = exact(context);
  for (const TableKind kind : {TableKind::explicit_stages, TableKind::diagonally_implicit})
    for (int o = 2; o <= 5; ++o)
      for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
        Pendulums system(tolerance);
        const ButcherTable t = table(kind, o);
        const auto s = solver(context, t, {}, system);
        const double error = difference(after(*s, 1e-3), reference);
        CAPTURE(o, tolerance, error);
        // TRBDF2's estimate is as good as the solution: errors then go with the power 2/3 of the tolerance.
        CHECK(error < 50.0 * (t.embedding < t.order ? tolerance : std::pow(tolerance, 2.0 / 3.0)));
        CHECK(s->counters().steps > 5);
      }
  Pendulums system(1e-2);
  system.stable = 0.05;
  const auto s = solver(context, table(TableKind::explicit_stages, 3), {}, system);
  s->start(0.0, 1.0);
  for (int k = 0; k < 10; ++k) {
    const auto step = s->step(100.0);
    CHECK(step.length <= 0.05);
    CHECK(step.limit == ArkSolver::Limit::stability);
  }
}

TEST_CASE(
    "The first stage of an explicit step is evaluated once, and not at all after a table that ends in it",
    "[integrators][sundials]") {
  const Context context;
  for (const auto& [name, per_step, more] :
       {std::tuple("ARKODE_BOGACKI_SHAMPINE_4_2_3", 3, 1), std::tuple("ARKODE_HEUN_EULER_2_1_2", 2, 0)}) {
    Pendulums system(1e-6);
    const auto s = solver(context, *find_table(TableKind::explicit_stages, name), {}, system);
    after(*s, 1.0);
    const auto c = s->counters();
    CAPTURE(name, c.steps, c.attempts);
    CHECK(c.attempts > c.steps);  // the first step is far too long
    const auto rejected = c.attempts - c.steps;
    // A repeated attempt knows its first stage.
    CHECK(c.right_hand_sides == per_step * c.steps + more + (per_step - 1 + more) * rejected);
    CHECK(system.evaluations == c.right_hand_sides);
  }
}

TEST_CASE("Work adds up over starts", "[integrators][sundials]") {
  const Context context;
  Pendulums system(1e-6);
  const auto s = solver(context, table(TableKind::diagonally_implicit, 3), {}, system);
  after(*s, 1e-2);
  const auto once = s->counters();
  s->y()[0] = 1.0, s->y()[1] = 0.5, s->y()[2] = 0.0, s->y()[3] = 0.0;
  after(*s, 1e-2);
  const auto twice = s->counters();
  CHECK(twice.steps == 2 * once.steps);
  CHECK(twice.newton_iterations >= 2 * once.newton_iterations - 5);
  CHECK(twice.right_hand_sides >= 2 * once.right_hand_sides - 5);
  CHECK(twice.factorisations > once.factorisations);
}

TEST_CASE("GMRES with either preconditioner finds what KLU finds", "[integrators][sundials]") {
  const Context context;
  const auto with = [&](LinearSolverKind linear) {
    Pendulums system(1e-8);
    ArkSettings settings;
    settings.fixed_step = 0.05;
    const auto s = solver(context, table(TableKind::diagonally_implicit, 3), settings, system, linear);
    return after(*s, 0.05);
  };
  const auto direct = with(LinearSolverKind::klu);
  CHECK(difference(direct, with(LinearSolverKind::gmres_with_factor)) < 1e-8);
  CHECK(difference(direct, with(LinearSolverKind::gmres_with_diagonal)) < 1e-8);
}

TEST_CASE("A right-hand side that fails shortens the step; at the end its own exception comes out",
          "[integrators][sundials]") {
  const Context context;
  for (const TableKind kind : {TableKind::explicit_stages, TableKind::diagonally_implicit}) {
    Pendulums system;
    ArkSettings settings;
    settings.shortest_step = 1e-9;
    system.forbidden_from = 0.5;
    auto s = solver(context, table(kind, 3), settings, system);
    s->start(0.0, 1.0);
    double t = 0.0;
    ArkSolver::Step step;
    for (int k = 0; k < 10000; ++k) {
      step = s->step(2.0);
      if (step.failure != ArkSolver::Failure::none) break;
      CHECK(step.time > t);
      t = step.time;
    }
    CAPTURE(static_cast<int>(kind), static_cast<int>(step.failure), step.length);
    CHECK(step.failure != ArkSolver::Failure::none);
    CHECK(t > 0.5 - 1e-3);
    CHECK(t <= 0.5);

    Pendulums other;
    other.throws_from = 0.5;
    s = solver(context, table(kind, 3), settings, other);
    s->start(0.0, 0.2);
    CHECK_THROWS_WITH(
        [&] {
          while (s->step(2.0).failure == ArkSolver::Failure::none) {
          }
        }(),
        "no further");
  }
}
