#include "app/solver_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "integrators/grid/error_scales.hpp"
#include "scene/start_nodes.hpp"

namespace vitrum::app {
namespace {

/// In an impact KLU is the faster one with 10,000 unknowns, GMRES with 26,000.
constexpr std::size_t many_unknowns = 20000;

/// Of the nodes that the bodies have a share in, without regard to boundaries.
std::size_t unknowns_of(const System& system) {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::size_t nodes = 0;
  for (const Body& body : system.bodies) nodes += nodes_of(system, body, {{-far, -far}, {far, far}}).size();
  return 2 * nodes;
}

/// Whether something moves clearly faster than the particles of a wave that reaches the elastic limit: steps
/// then resolve waves cell by cell, and GMRES needs few iterations. (KLU is the faster one at 1.2 times that
/// speed, GMRES at 1.7.)
bool is_impact(const Scene& scene, const System& system) {
  const ErrorScales scales = error_scales(system, {std::nullopt, scene.integrator.strain_scale});
  double wave_speed = 0.0;
  for (const Body& body : system.bodies) wave_speed = std::max(wave_speed, body.material->wave_speed());
  constexpr double clearly = 1.5;
  return scales.velocity > clearly * wave_speed * scales.strain;
}

}  // namespace

void warn_of_factors(const Scene& scene, const System& system, Warnings& list) {
  const IntegratorDefinition& integrator = scene.integrator;
  if (integrator.method != GridMethod::arkode_implicit || integrator.linear_solver != LinearSolver::klu ||
      integrator.fixed_step || !is_impact(scene, system))
    return;
  if (const std::size_t unknowns = unknowns_of(system); unknowns > many_unknowns)
    list.push_back(fmt::format(
        "{}: KLU takes most of a step with {} unknowns; linear_solver = \"gmres\" with preconditioner = "
        "\"diagonal\" factors nothing: measured impacts took half of the time with 26,000 unknowns "
        "and with 41,000",
        scene.at("integrator.linear_solver"), unknowns));
}

}  // namespace vitrum::app
