#include "scene/load_functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/computation_error.hpp"
#include "scene/choices.hpp"
#include "scene/formula_parser.hpp"

namespace vitrum {
namespace {

class Constant final : public mpm::LoadFunction {
 public:
  explicit Constant(double value) : value_(value) {}
  double at(double, const std::array<double, 2>&) const override { return value_; }
  double rate(double, double) const override { return 0.0; }

 private:
  double value_;
};

class FormulaFunction final : public mpm::LoadFunction {
 public:
  FormulaFunction(const Scene& scene, const std::string& path, const std::string& formula)
      : where_(scene.at(path)), formula_(formula), span_(scene.end - scene.start) {
    scene::prepare(parser_, scene::Formulas(scene::component_names(scene.geometry), scene.parameters),
                   &variables_.t, &variables_.place);
    parser_.SetExpr(formula.substr(1));
  }
  FormulaFunction(const FormulaFunction&) = delete;
  FormulaFunction& operator=(const FormulaFunction&) = delete;

  double at(double time, const std::array<double, 2>& place) const override {
    variables_.t = time, variables_.place = place;
    const double value = parser_.Eval();
    if (!std::isfinite(value))
      throw ComputationError(
          fmt::format("{}: found \"{}\" = {} at t = {:g} s, ({:g}, {:g}) m, expected a finite number", where_,
                      formula_, value, time, place[0], place[1]));
    return value;
  }

  /// The smaller of the one-sided differences, so that no jump counts.
  double rate(double time, double /*until*/) const override {
    const double h = 1e-6 * span_, here = at(time, {});
    const double after = (-3.0 * here + 4.0 * at(time + h, {}) - at(time + 2.0 * h, {})) / (2.0 * h),
                 before = (3.0 * here - 4.0 * at(time - h, {}) + at(time - 2.0 * h, {})) / (2.0 * h);
    return std::abs(after) < std::abs(before) ? after : before;
  }

 private:
  std::string where_, formula_;
  double span_;
  mutable scene::FormulaVariables variables_;
  mu::Parser parser_;
};

/// Piecewise linear, constant outside.
class TableFunction final : public mpm::LoadFunction {
 public:
  explicit TableFunction(const std::vector<Vector2>& rows) : rows_(rows) {}

  double at(double time, const std::array<double, 2>&) const override {
    const auto next = std::ranges::upper_bound(rows_, time, {}, [](const Vector2& row) { return row[0]; });
    if (next == rows_.begin()) return rows_.front()[1];
    if (next == rows_.end()) return rows_.back()[1];
    const Vector2 &a = *(next - 1), &b = *next;
    return a[1] + (time - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
  }
  double rate(double /*time*/, double until) const override {
    const auto next = std::ranges::lower_bound(rows_, until, {}, [](const Vector2& row) { return row[0]; });
    if (next == rows_.begin() || next == rows_.end()) return 0.0;
    const Vector2 &a = *(next - 1), &b = *next;
    return (b[1] - a[1]) / (b[0] - a[0]);
  }
  double next_kink(double time) const override {
    const auto next = std::ranges::upper_bound(rows_, time, {}, [](const Vector2& row) { return row[0]; });
    return next == rows_.end() ? std::numeric_limits<double>::infinity() : (*next)[0];
  }

 private:
  std::vector<Vector2> rows_;
};

}  // namespace

std::shared_ptr<const mpm::LoadFunction> load_function(const Scene& scene, const std::string& path) {
  const schema::Function* function = scene.function(path);
  if (function == nullptr) return nullptr;
  if (!function->formula.empty()) return std::make_shared<FormulaFunction>(scene, path, function->formula);
  return std::make_shared<TableFunction>(function->table);
}

std::shared_ptr<const mpm::LoadFunction> load_function(const Scene& scene, const std::string& path,
                                                       double number) {
  std::shared_ptr<const mpm::LoadFunction> function = load_function(scene, path);
  return function ? function : std::make_shared<Constant>(number);
}

}  // namespace vitrum
