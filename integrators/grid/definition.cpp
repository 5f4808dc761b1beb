#include "integrators/grid/definition.hpp"

#include "schema/field.hpp"

namespace vitrum {
namespace {

using schema::Field;
using schema::Named;
using schema::required;
using schema::Table;

constexpr std::array grid_methods{Named{"explicit", GridMethod::explicit_steps},
                                  Named{"arkode-explicit", GridMethod::arkode_explicit},
                                  Named{"arkode-implicit", GridMethod::arkode_implicit}};
constexpr std::array step_schemes{Named{"usf", StepScheme::usf}, Named{"usl", StepScheme::usl},
                                  Named{"musl", StepScheme::musl}};
constexpr std::array linear_solvers{Named{"klu", LinearSolver::klu}, Named{"gmres", LinearSolver::gmres}};
constexpr std::array preconditioners{Named{"factor", Preconditioner::factor},
                                     Named{"diagonal", Preconditioner::diagonal}};

/// Below, the rounding of one step's sums exceeds what is asked for.
constexpr Bounds tolerance{1.0e-13, 1.0, false, true};

}  // namespace

const Table& integrator_table() {
  using I = IntegratorDefinition;
  using intervals::positive;
  static const Table table = [] {
    Table t = schema::table_of<I>(
        "[integrator]",
        "The grid momentum equations. Keys of a method that is not chosen are validated and ignored.",
        {{"method", &I::method, grid_methods,
          "steps of one of the explicit schemes, or an adaptive method of ARKODE", required},
         {"scheme", &I::scheme, step_schemes,
          "explicit: when particle stress is updated: first, last, or last after a second projection of "
          "velocity"},
         {"step", &I::step, "s", positive, "explicit: fixed step, instead of `courant`"},
         Field<I>(
             "courant", &I::courant, "1", positive,
             "explicit: adaptive step, this fraction of the critical one; used when neither it nor `step` "
             "is given")
             .otherwise(0.4),
         {"max_growth",
          &I::max_growth,
          "1",
          {1.0, intervals::infinite, true, false},
          "watchdog: the run fails when (kinetic + elastic) / (initial + external work) passes this; inf: "
          "only non-finite values stop it"},
         Field<I>("order", &I::order, Bounds{2.0, 5.0},
                  "arkode-*: order of the Butcher table, instead of `table`")
             .otherwise(3),
         {"table", &I::table, "arkode-*: a Butcher table by its SUNDIALS name, instead of `order`"},
         {"rtol", &I::rtol, "1", tolerance, "arkode-*: tolerance relative to the scene's own scales"},
         {"velocity_scale", &I::velocity_scale, "m/s", positive,
          "arkode-*: scale of velocities; absent: the largest of initial speeds, prescribed velocities and "
          "wave speed x strain scale"},
         {"strain_scale", &I::strain_scale, "1", positive,
          "arkode-*: scale of strains; absent: the least elastic limit of the scene's materials"},
         {"fixed_step", &I::fixed_step, "s", positive,
          "arkode-*: switches adaptivity off (convergence studies)"},
         {"max_step", &I::max_step, "s", positive, "arkode-*: longest step"},
         {"min_step", &I::min_step, "s", positive, "arkode-*: shortest step"},
         {"initial_step", &I::initial_step, "s", positive, "arkode-*: first step"},
         {"linear_solver", &I::linear_solver, linear_solvers, "arkode-implicit"},
         {"preconditioner", &I::preconditioner, preconditioners,
          "arkode-implicit with gmres: a factored matrix of earlier steps, or a diagonal"},
         {"remap", &I::remap, "s", positive,
          "arkode-implicit: longest Lagrangian phase between remaps; absent: phases end by `remap_travel` "
          "and "
          "`remap_strain` alone"},
         {"remap_travel", &I::remap_travel, "cells", positive,
          "arkode-implicit: a phase ends when a node that matters has moved so far"},
         {"remap_strain", &I::remap_strain, "1", positive,
          "arkode-implicit: a phase ends when a particle has strained or turned so much"}});
    t.alternatives = {{{"step", "courant"}, ""}, {{"order", "table"}, ""}};
    return t;
  }();
  return table;
}

std::string_view name_of(GridMethod method) {
  return schema::name_of(grid_methods, method);
}

}  // namespace vitrum
