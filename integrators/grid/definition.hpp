#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "integrators/grid/step_scheme.hpp"
#include "schema/table.hpp"

namespace vitrum {

enum class GridMethod { explicit_steps, arkode_explicit, arkode_implicit };
enum class LinearSolver { klu, gmres };
enum class Preconditioner { factor, diagonal };

/// The scene table [integrator] as read.
struct IntegratorDefinition {
  GridMethod method = GridMethod::explicit_steps;
  StepScheme scheme = StepScheme::usf;
  std::optional<double> step;  ///< s; exactly one of step and courant is set
  std::optional<double> courant;
  double max_growth = 1.5;  ///< may be infinite
  // arkode-*
  std::optional<int> order;  ///< exactly one of order and table is set
  std::optional<std::string> table;
  double rtol = 1.0e-3;
  std::optional<double> velocity_scale, strain_scale;  ///< m/s, 1; absent: derived from the scene
  std::optional<double> fixed_step, max_step, min_step, initial_step;
  // arkode-implicit
  LinearSolver linear_solver = LinearSolver::klu;
  Preconditioner preconditioner = Preconditioner::factor;
  std::optional<double> remap;  ///< s; none: phases end by travel and strain alone
  double remap_travel = 0.25;   ///< cells
  double remap_strain = 0.02;
};

/// What the table may hold.
const schema::Table& integrator_table();
/// As scenes call it.
std::string_view name_of(GridMethod method);

}  // namespace vitrum
