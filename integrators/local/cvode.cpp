#include "integrators/local/cvode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "integrators/sundials/cvode_solver.hpp"

namespace vitrum {
namespace {

using sundials::CvodeMethod;
using sundials::CvodeSolver;

/// Solvers of one thread, by number of unknowns and method; made when first needed.
class Bundle {
 public:
  CvodeSolver& solver(std::size_t size, CvodeMethod method) {
    auto& owned = solvers_[static_cast<std::size_t>(method)][size];
    if (!owned) owned = std::make_unique<CvodeSolver>(context_, size, method);
    return *owned;
  }

 private:
  sundials::Context context_;
  std::array<std::array<std::unique_ptr<CvodeSolver>, ModeEquations::most_unknowns + 1>, 2> solvers_;
};

class ModeSystem final : public sundials::OdeSystem {
 public:
  explicit ModeSystem(const ModeEquations& equations) : equations_(equations) {}

  bool rates(double t, const double* y, double* out) override { return equations_.rates(t, y, out); }
  bool has_jacobian() const override { return equations_.has_jacobian(); }
  void jacobian(double t, const double* y, double* columns) override { equations_.jacobian(t, y, columns); }
  void roots(double t, const double* y, double* values) override {
    Guards g;
    equations_.guards(t, y, g);
    std::fill(values, values + CvodeSolver::roots, -1.0);
    std::copy(g.value.begin(), g.value.begin() + static_cast<std::ptrdiff_t>(g.count), values);
  }
  Guard guard(double t, const double* y, int index) const {
    Guards g;
    equations_.guards(t, y, g);
    return g.guard[static_cast<std::size_t>(index)];
  }

 private:
  const ModeEquations& equations_;
};

}  // namespace

bool Cvode::solve(const ModeEquations& equations, double* y, Stop& stop, PointReport& report) {
  static thread_local Bundle bundle;
  ModeSystem system(equations);
  const std::size_t n = equations.size();
  std::array<double, ModeEquations::most_unknowns> start{};
  std::copy(y, y + n, start.begin());
  const double whole = equations.parameter_end(), scale = equations.parameter_scale();
  const CvodeMethod configured = family_ == CvodeFamily::bdf ? CvodeMethod::bdf : CvodeMethod::adams;
  // Adams with a fixed-point iteration would need steps of the relaxation time of a stiff mode.
  const CvodeMethod first = equations.stiff() ? CvodeMethod::bdf : configured;
  std::array<double, ModeEquations::most_unknowns> absolute{};
  equations.absolute_tolerances(tolerance().relative, tolerance().absolute, absolute.data());
  struct Attempt {
    CvodeMethod method;
    double first_step, end;
  };
  constexpr int most_halvings = 20;
  CvodeSolver::Result result;
  for (int attempt = 0; attempt < 3 + most_halvings; ++attempt) {
    Attempt a{attempt < 2 ? first : CvodeMethod::bdf, attempt == 0 ? 0.0 : 1e-10 * scale, whole};
    if (attempt > 2) a.end = a.first_step = scale / static_cast<double>(1 << (attempt - 2));
    if (attempt > 2) a.first_step *= 1e-10;
    std::copy(start.begin(), start.begin() + static_cast<std::ptrdiff_t>(n), y);
    result =
        bundle.solver(n, a.method)
            .solve(system, y, a.end, {tolerance().relative, absolute.data(), scale, a.first_step, 20'000});
    report.solver.steps += result.steps;
    report.solver.right_hand_sides += result.right_hand_sides;
    if (!result.failed()) {
      stop.parameter = result.time;
      if (result.root >= 0)
        stop.guard = system.guard(result.time, y, result.root);
      else if (a.end == whole)
        stop.guard = path_end;
      return true;
    }
    ++report.solver.failures;
  }
  report.cause =
      fmt::format("CVODE gave up at {:.3g} of the increment's mode ({})", result.time, result.message());
  return false;
}

}  // namespace vitrum
