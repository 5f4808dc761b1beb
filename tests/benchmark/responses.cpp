// One increment of many points: every kind of material, every local integrator. items: increments.
#include <benchmark/benchmark.h>

#include "integrators/local/closed_form.hpp"
#include "integrators/local/cvode.hpp"
#include "integrators/local/substep.hpp"
#include "support/cracked_state.hpp"

namespace vitrum::benchmarks {
namespace {

using namespace vitrum::test;

constexpr std::size_t points = 256;
constexpr double duration = 1.0e-8;  // s

/// What the increment does to a point.
enum class Mode { elastic, damaging, flowing, crushed, opening, separated };
const char* const mode_names[] = {"elastic", "damaging", "flowing (von Mises)", "crushed (Drucker-Prager)",
                                  "opening", "separated"};
enum class Method { closed_form, substep, cvode_bdf, cvode_adams };
const char* const method_names[] = {"closed form", "substep", "CVODE (BDF)", "CVODE (Adams)"};

struct Case {
  MaterialParameters material;
  CompositeState start;
  SymmetricTensor strain;
};

/// A point that is about to do what the mode says, and the increment in which it does.
Case make_case(Mode mode) {
  MaterialParameters glass = fracturing_glass();
  glass.drucker_prager = glass_drucker_prager();
  const auto after = [](const MaterialParameters& p, const SymmetricTensor& strain, int increments) {
    const auto material = composite_of(p, cell);
    CompositeState s = material->initial_state({});
    PointReport report;
    for (int i = 0; i < increments; ++i)
      material->respond(s, (1.0 / increments) * strain, duration, report), report.clear();
    return s;
  };
  switch (mode) {
    case Mode::elastic:
      return {glass, after(glass, {-1e-5, -1e-5, -1e-5, 0.0}, 1), {1e-7, -1e-7, 0.0, 1e-7}};
    case Mode::damaging: {
      CompositeState s = after(glass, {6e-4, 6e-5, 6e-5, 0.0}, 100);
      return {glass, s, {6e-6, 6e-7, 6e-7, 0.0}};
    }
    case Mode::flowing: {
      const MaterialParameters steel = flowing_steel();
      return {steel, after(steel, {2e-3, -2e-3, 0.0, 2e-3}, 10), {1e-5, -1e-5, 0.0, 2e-5}};
    }
    case Mode::crushed:
      return {glass, after(glass, {-4e-3, 3e-3, 0.0, 0.0}, 10), {-1e-5, 8e-6, 0.0, 1e-5}};
    case Mode::opening: {
      const MaterialParameters p = cohesive_glass(5.0e-6);
      const auto material = composite_of(p, cell);
      return {p, at_onset(*material, 0.3, 20.0e6, 20.0e6 * normal_dyad(0.3)), 1e-5 * normal_dyad(0.3)};
    }
    case Mode::separated: {
      const MaterialParameters p = cohesive_glass(5.0e-6);
      const auto material = composite_of(p, cell);
      CompositeState s = at_onset(*material, 0.3, 20.0e6, 20.0e6 * normal_dyad(0.3));
      PointReport report;
      for (int i = 0; i < 20; ++i)
        material->respond(s, 1e-3 * normal_dyad(0.3), duration, report), report.clear();
      return {p, s, {1e-6, -1e-6, 0.0, 1e-6}};
    }
  }
  return {};
}

std::unique_ptr<LocalIntegrator> make_method(Method method) {
  switch (method) {
    case Method::closed_form:
      return std::make_unique<ClosedForm>();
    case Method::substep:
      return std::make_unique<Substep>(LocalTolerance{});
    case Method::cvode_bdf:
      return std::make_unique<Cvode>(LocalTolerance{}, CvodeFamily::bdf);
    case Method::cvode_adams:
      return std::make_unique<Cvode>(LocalTolerance{}, CvodeFamily::adams);
  }
  return nullptr;
}

/// Many copies of a point; the start of the increment is kept, so that every turn does the same.
class Points {
 public:
  explicit Points(const Case& c)
      : material(composite_of(c.material, cell)), mass_(points, 1.0), spin_(points, 1e-6) {
    const auto column = [&](std::vector<double>& v, double value) {
      v.assign(points, value);
      return v.data();
    };
    const SymmetricTensor &e = c.start.elastic_strain, &d = c.strain;
    const double start[] = {e.rr, e.zz, e.tt, e.rz}, strain[] = {d.rr, d.zz, d.tt, d.rz};
    for (std::size_t k = 0; k < 4; ++k) {
      columns.start_strain[k] = column(start_[k], start[k]);
      columns.strain_increment[k] = column(strain_[k], strain[k]);
      columns.elastic_strain[k] = column(end_[k], 0.0);
    }
    start_variables_.resize(material->columns().size()), end_variables_.resize(material->columns().size());
    for (std::size_t k = 0; k < start_variables_.size(); ++k) {
      columns.start_variables.push_back(
          column(start_variables_[k], number(c.start, material->columns()[k].name)));
      columns.variables.push_back(column(end_variables_[k], 0.0));
    }
    columns.mass = mass_.data(), columns.spin_increment = spin_.data();
  }

  std::shared_ptr<const CompositeMaterial> material;
  ParticleColumns columns;

 private:
  std::vector<double> start_[4], strain_[4], end_[4], mass_, spin_;
  std::vector<std::vector<double>> start_variables_, end_variables_;
};

/// Whether the increment did what its mode says: otherwise the figure would be of something else.
bool as_intended(Mode mode, const BatchReport& report, const Points& p) {
  const std::optional<std::size_t> lambda = p.material->door().column("decohesion");
  switch (mode) {
    case Mode::elastic:
      return report.dissipated.total() == 0.0 && report.events.empty();
    case Mode::damaging:
      return report.dissipated.damage > 0.0 && report.dissipated.fracture == 0.0;
    case Mode::flowing:
    case Mode::crushed:
      return report.dissipated.plastic > 0.0 && report.dissipated.fracture == 0.0;
    case Mode::opening:
      return report.dissipated.fracture > 0.0 && p.columns.variables[*lambda][0] < 1.0;
    case Mode::separated:
      return p.columns.variables[*lambda][0] >= 1.0;
  }
  return false;
}

void response(benchmark::State& state) {
  const auto mode = static_cast<Mode>(state.range(0));
  const auto method = static_cast<Method>(state.range(1));
  Points p(make_case(mode));
  const auto local = make_method(method);
  BatchReport report;
  for ([[maybe_unused]] auto _ : state) {
    report.clear();
    local->integrate(p.material->door(), p.columns, 0, points, duration, report);
    benchmark::ClobberMemory();
  }
  if (report.failed)
    state.SkipWithError(report.cause.c_str());
  else if (!as_intended(mode, report, p))
    state.SkipWithError("the increment does not do what its mode says");
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points));
  state.SetLabel(std::string(mode_names[state.range(0)]) + ", " + method_names[state.range(1)]);
  state.counters["solver_steps"] = static_cast<double>(report.solver.steps) / points;
}
BENCHMARK(response)
    ->ArgNames({"mode", "method"})
    ->ArgsProduct({{0, 1, 2, 3, 4, 5}, {0, 1, 2, 3}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace vitrum::benchmarks
