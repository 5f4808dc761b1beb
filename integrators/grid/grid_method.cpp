#include "integrators/grid/grid_method.hpp"

#include <limits>
#include <stdexcept>

#include "integrators/grid/arkode_explicit.hpp"
#include "integrators/grid/explicit.hpp"

namespace vitrum {
namespace {

AdaptiveSettings adaptive_settings(const IntegratorDefinition& i, const System& initial) {
  return {butcher_table(i), i.rtol,     error_scales(initial, {i.velocity_scale, i.strain_scale}),
          i.fixed_step,     i.max_step, i.min_step,
          i.initial_step};
}

sundials::LinearSolverKind linear_solver(const IntegratorDefinition& i) {
  using Kind = sundials::LinearSolverKind;
  if (i.linear_solver == LinearSolver::klu) return Kind::klu;
  return i.preconditioner == Preconditioner::factor ? Kind::gmres_with_factor : Kind::gmres_with_diagonal;
}

}  // namespace

sundials::TableKind table_kind(GridMethod method) {
  return method == GridMethod::arkode_implicit ? sundials::TableKind::diagonally_implicit
                                               : sundials::TableKind::explicit_stages;
}

sundials::ButcherTable butcher_table(const IntegratorDefinition& integrator) {
  const sundials::TableKind kind = table_kind(integrator.method);
  const std::string name =
      integrator.table ? *integrator.table : sundials::table_of_order(kind, integrator.order.value());
  const auto table = sundials::find_table(kind, name);
  if (!table) throw std::invalid_argument("integrator.table: SUNDIALS has no table " + name);
  return *table;
}

RemapSettings remap_settings(const IntegratorDefinition& i) {
  return {i.remap.value_or(std::numeric_limits<double>::infinity()), i.remap_travel, i.remap_strain};
}

std::unique_ptr<GridIntegrator> make_grid_integrator(const IntegratorDefinition& integrator,
                                                     const System& initial) {
  switch (integrator.method) {
    case GridMethod::explicit_steps:
      return std::make_unique<ExplicitIntegrator>(integrator.scheme, integrator.step, integrator.courant);
    case GridMethod::arkode_explicit:
      return std::make_unique<ArkodeExplicit>(adaptive_settings(integrator, initial));
    case GridMethod::arkode_implicit:
      return std::make_unique<ArkodeImplicit>(adaptive_settings(integrator, initial),
                                              remap_settings(integrator), linear_solver(integrator));
  }
  return nullptr;
}

}  // namespace vitrum
