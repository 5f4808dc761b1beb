#include "short_run.hpp"

#include <cmath>
#include <memory>

#include "app/demands.hpp"
#include "app/warnings.hpp"
#include "app/watchdog.hpp"
#include "mpm/stress.hpp"
#include "observe/energy_ledger.hpp"
#include "observe/failure.hpp"
#include "output/particle_fields.hpp"
#include "promises.hpp"
#include "scene/build_system.hpp"
#include "integrators/grid/grid_method.hpp"
#include "scene/read_scene.hpp"
#include "scene/seeding.hpp"
#include "scene/write_scene.hpp"

namespace vitrum::fuzz {
namespace {

constexpr double most_particles = 150.0;
constexpr int most_steps = 3;

bool is_small(const Scene& scene) {
  const SceneSize size = size_of(scene);
  demand(size.memory > 0.0, "the memory of a scene is estimated");
  double particles = 0.0;
  for (const BodyDefinition& body : scene.bodies)
    particles += most_seeds(body.shape, scene.cell, static_cast<int>(std::sqrt(body.particles_per_cell)));
  return particles <= most_particles;
}

bool is_finite(const System& system) {
  for (const Body& body : system.bodies) {
    const Particles& p = body.particles;
    const auto stress = mpm::stress_of(body);
    for (std::size_t i = 0; i < p.size; ++i) {
      double sum = p.position[0][i] + p.position[1][i] + p.velocity[0][i] + p.velocity[1][i];
      for (const auto& column : stress) sum += column[i];
      if (!std::isfinite(sum)) return false;
    }
  }
  return true;
}

class FewSteps final : public StepObserver {
 public:
  FewSteps(const Scene& scene, System& system, const GridIntegrator& integrator)
      : ledger_(system), failure_(system), watchdog_(scene.integrator.max_growth, integrator) {}

  bool step_done(System& system, double step) override {
    ledger_.step(system, 0.0);
    failure_.step(system, step);
    if (watchdog_.look(system, ledger_, step)) return false;
    demand(is_finite(system), "what the watchdog lets pass is finite");
    return ++steps_ < most_steps;
  }
  void report(const System& system) const { (void)failure_.report(system, is_finite(system)); }

 private:
  EnergyLedger ledger_;
  FailureAnalysis failure_;
  app::Watchdog watchdog_;
  int steps_ = 0;
};

}  // namespace

void exercise(const Scene& scene) {
  const std::string resolved = resolved_toml(scene);
  Scene again = parse_scene(resolved, "resolved.toml");
  again.formulas = scene.formulas;  // comments, which are not read
  demand(resolved_toml(again) == resolved,
         "the resolved scene reads as the same scene");
  if (!is_small(scene)) return;
  System system = build_system(scene, 1);
  output::select_fields(scene, output::materials_of(system.bodies));
  (void)app::warnings(scene, system, 1);
  app::require_time(scene, system, app::work_of(scene, system, 1), 1);
  (void)app::disk_space_of(scene, system, true);
  const std::unique_ptr<GridIntegrator> integrator = make_grid_integrator(scene.integrator, system);
  FewSteps observer(scene, system, *integrator);
  integrator->advance(system, scene.end, observer);
  observer.report(system);
}

}  // namespace vitrum::fuzz
