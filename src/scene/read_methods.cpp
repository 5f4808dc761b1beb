#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <tuple>

#include "scene/choices.hpp"
#include "scene/grid_method.hpp"
#include "scene/scene_keys.hpp"
#include "scene/sections.hpp"
#include "scene/suggestion.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

/// Of two keys that exclude each other, the one that the file gives later is reported.
void exclude(const TableReader& table, std::string_view one, std::string_view other) {
  if (!table.has(one) || !table.has(other)) return;
  const auto a = table.position(one), b = table.position(other);
  const bool one_is_later = std::tuple(a.line, a.column) > std::tuple(b.line, b.column);
  const std::string_view later = one_is_later ? one : other, earlier = one_is_later ? other : one;
  table.report(later, fmt::format("found together with '{}', expected only one of the two",
                                  join_path(table.path(), earlier)));
}

/// A table must be one that SUNDIALS has, of the kind that the method takes, with an embedding where steps
/// adapt. (A scene of explicit steps may hold either kind.)
void check_butcher_table(const TableReader& table, const IntegratorDefinition& integrator) {
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
  if (std::find(known.begin(), known.end(), *integrator.table) == known.end()) {
    table.fail("table", with_suggestion(expected, *integrator.table, known));
    return;
  }
  if (integrator.method != GridMethod::explicit_steps && !integrator.fixed_step &&
      butcher_table(integrator).embedding == 0)
    table.fail("table", "a table with an embedding, or 'integrator.fixed_step'");
}

}  // namespace

void read_integrator(const TableReader& document, Scene& scene) {
  IntegratorDefinition& integrator = scene.integrator;
  const auto table = document.table("integrator", keys::integrator());
  if (!table) return;
  table->read_choice("method", integrator.method);
  table->read_choice("scheme", integrator.scheme);
  table->read("step", integrator.step);
  require_countable(*table, "step", integrator.step, scene);
  table->read("courant", integrator.courant);
  exclude(*table, "step", "courant");
  if (!table->has("step") && !table->has("courant")) integrator.courant = keys::default_courant;
  table->read("max_growth", integrator.max_growth);
  table->read("order", integrator.order);
  table->read("table", integrator.table);
  exclude(*table, "order", "table");
  table->read("rtol", integrator.rtol);
  table->read("velocity_scale", integrator.velocity_scale);
  table->read("strain_scale", integrator.strain_scale);
  table->read("fixed_step", integrator.fixed_step);
  table->read("initial_step", integrator.initial_step);
  const bool shortest = table->read("min_step", integrator.min_step);
  if (table->read("max_step", integrator.max_step) && shortest && *integrator.max_step < *integrator.min_step)
    table->fail("max_step",
                fmt::format("at least 'integrator.min_step' ({})", number_text(*integrator.min_step)));
  std::size_t solver = 0;
  if (table->read_choice("linear_solver", solver)) integrator.linear_solver = linear_solver_names[solver];
  if (table->read_choice("preconditioner", solver)) integrator.preconditioner = preconditioner_names[solver];
  table->read("remap", integrator.remap);
  require_countable(*table, "fixed_step", integrator.fixed_step, scene);
  require_countable(*table, "max_step", integrator.max_step, scene);
  require_countable(*table, "remap", integrator.remap, scene);
  table->read("remap_travel", integrator.remap_travel);
  table->read("remap_strain", integrator.remap_strain);
  check_butcher_table(*table, integrator);
}

void read_constitutive(const TableReader& document, ConstitutiveDefinition& constitutive) {
  const auto table = document.table("constitutive", keys::constitutive());
  if (!table) return;
  table->read_choice("method", constitutive.method);
  table->read("rtol", constitutive.rtol);
  table->read("atol", constitutive.atol);
  std::size_t solver = 0;
  if (table->read_choice("solver", solver)) constitutive.solver = local_solver_names[solver];
}

}  // namespace vitrum::scene
