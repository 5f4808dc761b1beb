#pragma once
#include <optional>

#include "integrators/local/local_integrator.hpp"
#include "materials/event_driven.hpp"

namespace vitrum {

/// Error tolerances of the local equations: |error| <= rtol |y| + atol x scale, for every unknown.
struct LocalTolerance {
  double relative = 1.0e-6, absolute = 1.0e-9;
};

/// Follows an increment from event to event: straight pieces without a solver, the others by `solve`. A
/// mode's equations are smooth between events, and a solver starts anew behind each.
class PathFollower : public LocalIntegrator {
 public:
  explicit PathFollower(const LocalTolerance& tolerance) : tolerance_(tolerance) {}
  using LocalIntegrator::integrate;
  void integrate(const Material& material, const ParticleColumns& particles, std::size_t begin,
                 std::size_t end, double duration, BatchReport& report) final {
    material.advance(particles, begin, end, duration, this, report);
  }
  void integrate(const Material& material, PointState& state, const SymmetricTensor& strain_increment,
                 double duration, PointReport& report) final;

 protected:
  /// Where a solver stopped: at a guard, at the end of the path (path_end), or on the way (none).
  struct Stop {
    double parameter = 0.0;
    std::optional<Guard> guard;
  };
  /// Takes y from the parameter 0 as far as it can. False: not at all, and report.cause says why. Called from
  /// several threads.
  virtual bool solve(const ModeEquations& equations, double* y, Stop& stop, PointReport& report) = 0;

  const LocalTolerance& tolerance() const { return tolerance_; }

 private:
  bool follow(Course& course, PointReport& report);

  LocalTolerance tolerance_;
};

}  // namespace vitrum
