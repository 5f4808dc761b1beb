#pragma once
#include <functional>
#include <string>
#include <utility>

#include "integrators/grid/grid_method.hpp"
#include "mpm/computation_error.hpp"
#include "observe/energy_ledger.hpp"
#include "scene/build_system.hpp"
#include "scene/read_scene.hpp"
#include "support/mpm_scene.hpp"
#include "support/reorder.hpp"

namespace vitrum::test {

/// A scene that is being computed, with its energy account.
class MpmRun final : private StepObserver {
 public:
  explicit MpmRun(const Scene& scene, int threads = 1)
      : system(build_system(scene, threads)),
        integrator_(make_grid_integrator(scene.integrator, system)),
        integrator(*integrator_),
        ledger(system) {}
  explicit MpmRun(const MpmScene& scene, int threads = 1)
      : MpmRun(parse_scene(scene.text(), "test.toml"), threads) {}

  /// Called after every step with its length (s); false stops the run.
  std::function<bool(double)> watch;

  bool advance(double target) {
    const bool reached = integrator.advance(system, target, *this);
    put_in_order();
    return reached;
  }
  /// Opens the energy account anew: for tests that set particle states themselves.
  void reopen_ledger() { ledger = EnergyLedger(system); }

  Particles& particles(std::size_t body = 0) { return system.bodies[body].particles; }
  const EnergyTotals& energy() const { return ledger.totals(); }

  System system;

 private:
  std::unique_ptr<GridIntegrator> integrator_;

 public:
  GridIntegrator& integrator;
  EnergyLedger ledger;

 private:
  /// Particles back in the order in which they were seeded, where tests look for them. Results do not depend
  /// on it.
  void put_in_order() {
    for (Body& body : system.bodies) {
      if (body.removed > 0) continue;  // the storage says who has left
      std::vector<std::uint32_t> place(body.particles.size);
      for (std::uint32_t i = 0; i < place.size(); ++i) place[body.particles.identity[i]] = i;
      reorder(body.particles, place);
    }
    system.grid_is_stale = true;
  }

  bool step_done(System& stepped, double step) override {
    ledger.step(stepped, 0.0);
    if (watch && !watch(step)) return false;
    // A step that follows the speed of particles shrinks without end when they run away.
    if (!(ledger.growth() < 100.0)) throw ComputationError("the test's run has blown up");
    return true;
  }
};

/// Total momentum, kg m/s (per radian or per metre).
inline std::array<double, 2> total_momentum(const System& system) {
  std::array<double, 2> sum{};
  for (const Body& body : system.bodies)
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t i = 0; i < body.particles.size; ++i)
        sum[k] += body.particles.mass[i] * body.particles.velocity[k][i];
  return sum;
}

/// Mass-weighted mean of a particle quantity.
inline double mass_mean(const Particles& p, const std::vector<double>& values) {
  double sum = 0.0, mass = 0.0;
  for (std::size_t i = 0; i < p.size; ++i) sum += p.mass[i] * values[i], mass += p.mass[i];
  return sum / mass;
}

}  // namespace vitrum::test
