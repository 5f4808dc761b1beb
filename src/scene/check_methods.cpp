#include <fmt/format.h>

#include <algorithm>

#include "integrators/grid/grid_method.hpp"
#include "scene/checks.hpp"
#include "scene/suggestion.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

/// An interval (s) that fits into the scene's duration more than 1e12 times: such a run would not end, and
/// far beyond it the intervals can no longer be counted.
void require_countable(const TableView& table, std::string_view key, const std::optional<double>& interval,
                       const Scene& scene) {
  constexpr double most = 1e12;
  const double least = (scene.end - scene.start) / most;
  if (interval && *interval < least)
    table.fail(key,
               fmt::format("at least {:.3g} s (a million-millionth of the time from start to end)", least));
}

/// A table must be one that SUNDIALS has, of the kind that the method takes, with an embedding where steps
/// adapt. (A scene of explicit steps may hold either kind.)
void check_butcher_table(const TableView& table, const IntegratorDefinition& integrator) {
  using sundials::TableKind;
  if (!integrator.table) return;
  std::vector<std::string> known = sundials::table_names(table_kind(integrator.method));
  std::string expected =
      integrator.method == GridMethod::arkode_implicit
          ? fmt::format("SUNDIALS' name of a diagonally implicit Butcher table, such as {}", known[1])
          : fmt::format("SUNDIALS' name of an explicit Butcher table, such as {}", known[1]);
  if (integrator.method == GridMethod::explicit_steps) {
    const std::vector<std::string> more = sundials::table_names(TableKind::diagonally_implicit);
    known.insert(known.end(), more.begin(), more.end());
    expected = "SUNDIALS' name of a Butcher table";
  }
  if (std::ranges::find(known, *integrator.table) == known.end())
    table.fail("table", with_suggestion(expected, *integrator.table, known));
  else if (integrator.method != GridMethod::explicit_steps && !integrator.fixed_step &&
           butcher_table(integrator).embedding == 0)
    table.fail("table", "a table with an embedding, or 'integrator.fixed_step'");
}

void check_integrator(const TableView& table, const Scene& scene) {
  const IntegratorDefinition& integrator = scene.integrator;
  require_countable(table, "step", integrator.step, scene);
  require_countable(table, "fixed_step", integrator.fixed_step, scene);
  require_countable(table, "max_step", integrator.max_step, scene);
  require_countable(table, "remap", integrator.remap, scene);
  if (integrator.min_step && integrator.max_step && *integrator.max_step < *integrator.min_step)
    table.fail("max_step",
               fmt::format("at least 'integrator.min_step' ({})", number_text(*integrator.min_step)));
  check_butcher_table(table, integrator);
}

}  // namespace

void check_methods(const TableView& document, const Scene& scene) {
  const auto time = document.table("time");
  if (time && time->sound("start") && time->sound("end") && !(scene.end > scene.start))
    time->fail("end", fmt::format("a time later than 'time.start' ({})", number_text(scene.start)));
  if (const auto integrator = document.table("integrator")) check_integrator(*integrator, scene);
  if (const auto output = document.table("output")) {
    require_countable(*output, "every", scene.output.every, scene);
    require_countable(*output, "checkpoint_every", scene.output.checkpoint_every, scene);
    require_countable(*output, "history_every", scene.output.history_every, scene);
  }
}

}  // namespace vitrum::scene
