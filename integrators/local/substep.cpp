#include "integrators/local/substep.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace vitrum {
namespace {

constexpr int most_unknowns = static_cast<int>(ModeEquations::most_unknowns);
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_unknowns, 1>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_unknowns, most_unknowns>;

/// A step of length h from (t, y): the end, the estimate of its error, and the rates there. Not finite:
/// failed.
struct Step {
  Vector end, error, rates;
  bool finite = true;
};

class Stepper {
 public:
  Stepper(const ModeEquations& equations, PointReport& report) : equations_(equations), report_(report) {}

  Vector rates(double t, const Vector& y, bool& finite) {
    Vector f(y.size());
    finite = equations_.rates(t, y.data(), f.data()) && finite;
    ++report_.solver.right_hand_sides;
    return f;
  }

  Step take(double t, const Vector& y, const Vector& f0, double h) {
    return equations_.stiff() ? rosenbrock(t, y, f0, h) : bogacki_shampine(t, y, f0, h);
  }

 private:
  Step bogacki_shampine(double t, const Vector& y, const Vector& k1, double h) {
    Step s;
    const Vector k2 = rates(t + 0.5 * h, y + 0.5 * h * k1, s.finite);
    const Vector k3 = rates(t + 0.75 * h, y + 0.75 * h * k2, s.finite);
    s.end = y + h / 9.0 * (2.0 * k1 + 3.0 * k2 + 4.0 * k3);
    s.rates = rates(t + h, s.end, s.finite);
    s.error = h / 72.0 * (-5.0 * k1 + 6.0 * k2 + 8.0 * k3 - 9.0 * s.rates);
    return s;
  }

  Step rosenbrock(double t, const Vector& y, const Vector& f0, double h) {
    const double d = 1.0 / (2.0 + std::sqrt(2.0)), e32 = 6.0 + std::sqrt(2.0);
    Step s;
    const double dt = std::max(std::sqrt(1e-16), 1e-8 * h);
    const Vector explicit_part = (h * d / dt) * (rates(t + dt, y, s.finite) - f0);
    const Eigen::PartialPivLU<Matrix> w(Matrix::Identity(y.size(), y.size()) -
                                        h * d * jacobian(t, y, f0, s.finite));
    const Vector k1 = w.solve(f0 + explicit_part);
    const Vector f1 = rates(t + 0.5 * h, y + 0.5 * h * k1, s.finite);
    const Vector k2 = w.solve(f1 - k1) + k1;
    s.end = y + h * k2;
    s.rates = rates(t + h, s.end, s.finite);
    const Vector k3 = w.solve(s.rates - e32 * (k2 - f1) - 2.0 * (k1 - f0) + explicit_part);
    s.error = h / 6.0 * (k1 - 2.0 * k2 + k3);
    return s;
  }

  Matrix jacobian(double t, const Vector& y, const Vector& f0, bool& finite) {
    Matrix J(y.size(), y.size());
    if (equations_.has_jacobian()) {
      equations_.jacobian(t, y.data(), J.data());
      return J;
    }
    for (Eigen::Index j = 0; j < y.size(); ++j) {
      Vector moved = y;
      const double change = 1e-8 * std::max(std::abs(y[j]), 1e-3);
      moved[j] += change;
      J.col(j) = (rates(t, moved, finite) - f0) / (moved[j] - y[j]);
    }
    return J;
  }

  const ModeEquations& equations_;
  PointReport& report_;
};

/// Event functions that count: those that have been below zero since the mode began, or that began above it,
/// by the error of what came before, and fell (they may be back before a substep is over). These count when
/// they rise beyond where they began.
class Watch {
 public:
  explicit Watch(const ModeEquations& equations) : equations_(equations) {}

  /// The mode begins at (t, y). step: short, with the rates there.
  void begin(double t, const Vector& y, const Vector& rates, double step) {
    Guards g, ahead;
    equations_.guards(t, y.data(), g);
    const Vector next = y + step * rates;
    equations_.guards(t + step, next.data(), ahead);
    for (std::size_t k = 0; k < g.count; ++k) {
      armed_[k] = g.value[k] < 0.0 || ahead.value[k] < g.value[k];
      beyond_[k] = std::max(0.0, g.value[k]);
    }
  }
  void arm(double t, const Vector& y) {
    Guards g;
    equations_.guards(t, y.data(), g);
    for (std::size_t k = 0; k < g.count; ++k)
      if (g.value[k] < 0.0) armed_[k] = true, beyond_[k] = 0.0;
  }
  /// The largest guard that counts at (t, y), over where it began, and that guard when above zero.
  struct Passed {
    double value = -1.0;
    std::optional<Guard> guard;
  };
  Passed passed(double t, const Vector& y) const {
    Guards g;
    equations_.guards(t, y.data(), g);
    Passed p;
    for (std::size_t k = 0; k < g.count; ++k)
      if (const double value = g.value[k] - beyond_[k]; armed_[k] && value > p.value)
        p = {value, value > 0.0 ? std::optional(g.guard[k]) : std::nullopt};
    return p;
  }

 private:
  const ModeEquations& equations_;
  std::array<bool, Guards::capacity> armed_{};
  std::array<double, Guards::capacity> beyond_{};
};

}  // namespace

bool Substep::solve(const ModeEquations& equations, double* out, Stop& stop, PointReport& report) {
  constexpr int most_substeps = 200'000;
  const auto n = static_cast<Eigen::Index>(equations.size());
  Eigen::Map<Eigen::VectorXd> result(out, n);
  Stepper stepper(equations, report);
  Vector y = result;
  Watch watch(equations);
  bool finite = true;
  double t = 0.0;
  Vector f = stepper.rates(t, y, finite);
  Vector absolute(n);
  equations.absolute_tolerances(tolerance().relative, tolerance().absolute, absolute.data());
  const auto weighted = [&](const Vector& error, const Vector& at) {
    return (error.array().abs() / (tolerance().relative * at.array().abs() + absolute.array())).maxCoeff();
  };
  const double end = equations.parameter_end();
  const double longest = equations.parameter_scale(), shortest = 1e-15 * longest;
  const double order = 3.0;  // of the local error estimate
  // A first step that moves no unknown by more than its tolerance allows for a constant second derivative.
  double h = longest * std::clamp(0.5 * std::cbrt(tolerance().relative), 1e-4, 0.5);
  if (!finite) {
    report.cause = "the rates at the start of a mode are not finite";
    return false;
  }
  watch.begin(t, y, f, 1e-9 * longest);
  for (int i = 0; i < most_substeps; ++i) {
    const bool last = t + h >= end;
    if (last) h = end - t;
    Step step = stepper.take(t, y, f, h);
    ++report.solver.steps;
    const double error =
        step.finite ? weighted(step.error, step.end) : std::numeric_limits<double>::infinity();
    if (!(error <= 1.0)) {
      h *= std::clamp(std::isfinite(error) ? 0.9 * std::pow(error, -1.0 / order) : 0.1, 0.1, 0.9);
      if (h < shortest) {
        Eigen::Index worst = 0;
        if (step.finite) (step.error.array().abs()).maxCoeff(&worst);
        report.cause = fmt::format("the substep collapsed; the largest error is that of the {}",
                                   equations.name(static_cast<std::size_t>(worst)));
        return false;
      }
      continue;
    }
    Watch::Passed now = watch.passed(t + h, step.end);
    if (now.guard) {
      // Shorten the substep to the first event: bisection with secants (Illinois) on the largest event
      // function.
      double low = 0.0, high = h;
      double at_low = std::min(watch.passed(t, y).value, -1e-300), at_high = now.value;
      Step landed = step;
      for (int k = 0; k < 200 && high - low > 1e-14 * longest; ++k) {
        double middle = low + (high - low) * at_low / (at_low - at_high);
        if (k % 3 == 2 || !(middle > low && middle < high)) middle = 0.5 * (low + high);
        const Step trial = stepper.take(t, y, f, middle);
        const Watch::Passed there = watch.passed(t + middle, trial.end);
        if (there.guard)
          high = middle, at_high = there.value, now = there, landed = trial;
        else
          low = middle, at_low = std::min(there.value, -1e-300);
      }
      result = landed.end;
      stop = {t + high, now.guard};
      return true;
    }
    t = last ? end : t + h;
    y = step.end;
    equations.project(t, y.data());
    watch.arm(t, y);
    f = stepper.rates(t, y, finite);
    if (last) {
      result = y;
      stop = {end, path_end};
      return true;
    }
    const double growth = error > 0.0 ? 0.9 * std::pow(error, -1.0 / order) : 5.0;
    h = std::min(h * std::clamp(growth, 0.2, 5.0), longest);
  }
  report.cause = fmt::format("more than {} substeps in one mode", most_substeps);
  return false;
}

}  // namespace vitrum
