#pragma once
#include <string>
#include <vector>

#include "observe/energy_ledger.hpp"
#include "observe/failure.hpp"
#include "scene/build_system.hpp"
#include "integrators/grid/grid_method.hpp"
#include "scene/read_scene.hpp"
#include "vitrum_source_dir.hpp"

namespace vitrum::benchmarks {

/// A scene of studies/, with `--set` overrides.
inline Scene study(const std::string& file, const std::vector<std::string>& overrides = {}) {
  return read_scene(std::string(VITRUM_SOURCE_DIR) + "/studies/" + file, overrides);
}

/// The elastic bar and the two disks with about `thousands` thousand particles: 1, 5 (bar), 20, 80 or 500.
Scene bar(long thousands, std::vector<std::string> overrides = {});
Scene disks(long thousands, std::vector<std::string> overrides = {});
/// The paper's reference case with a step that resolves it.
Scene reference_case(std::vector<std::string> overrides = {});

/// A scene under way, with the bookkeeping that a run does after every step.
class RunningScene final : private StepObserver {
 public:
  explicit RunningScene(const Scene& scene, int threads = 1)
      : system(build_system(scene, threads)),
        integrator(make_grid_integrator(scene.integrator, system)),
        ledger_(system),
        failure_(system) {}

  /// Takes `steps` steps, or fewer when the scene ends at `target` (s).
  void advance(int steps, double target) {
    left_ = steps;
    integrator->advance(system, target, *this);
  }

  System system;
  std::unique_ptr<GridIntegrator> integrator;

 private:
  bool step_done(System& stepped, double step) override {
    ledger_.step(stepped, 0.0);
    failure_.step(stepped, step);
    return --left_ > 0;
  }

  EnergyLedger ledger_;
  FailureAnalysis failure_;
  int left_ = 0;
};

}  // namespace vitrum::benchmarks
