#pragma once
#include <memory>

#include "integrators/grid/arkode_implicit.hpp"
#include "integrators/grid/critical_step.hpp"
#include "integrators/grid/definition.hpp"
#include "integrators/grid/grid_integrator.hpp"
#include "integrators/sundials/butcher_table.hpp"

namespace vitrum {

/// The grid integrator that [integrator] names. initial: the system at the start of the scene (also for a run
/// that is resumed), from which the scales of tolerances are taken.
std::unique_ptr<GridIntegrator> make_grid_integrator(const IntegratorDefinition& integrator,
                                                     const System& initial);

/// When a Lagrangian phase of the integrator ends.
RemapSettings remap_settings(const IntegratorDefinition& integrator);

/// The kind of table that an arkode method takes.
sundials::TableKind table_kind(GridMethod method);
/// The table that an arkode method uses.
sundials::ButcherTable butcher_table(const IntegratorDefinition& integrator);

}  // namespace vitrum
