#include "app/point_path.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "mpm/computation_error.hpp"
#include "integrators/local/local_method.hpp"

namespace vitrum::app {
namespace {

/// The point on its way.
class Walk {
 public:
  Walk(const PointScene& scene, const Material& material, const PathListener& listener)
      : material_(material),
        listener_(listener),
        local_(make_local_integrator(scene.constitutive)),
        time_(scene.time[0]),
        state_(scene.state) {
    PointReport report;
    material.judge(state_, report);
    tell_events(report, time_);
    // A path that does not start at zero strain starts with a jump to its first point.
    if (scene.strain[0] != SymmetricTensor{}) advance(time_, scene.strain[0]);
  }

  void advance(double to, const SymmetricTensor& target) {
    PointReport report;
    local_->integrate(material_, state_, target - strain_, to - time_, report);
    if (report.failed())
      throw ComputationError(
          fmt::format("t = {} s: {}; try constitutive.method = \"closed-form\", another constitutive.rtol, "
                      "or a finer strain path",
                      time_, report.cause));
    tell_events(report, to);
    if (!std::isfinite(trace(state_.stress) + state_.stress.rz + state_.dissipated))
      throw ComputationError(
          fmt::format("t = {} s: the stress is not finite (strain {}, {}, {}, {}); reduce the strain path",
                      to, target.rr, target.zz, target.tt, target.rz));
    strain_ = target;
    time_ = to;
  }
  void tell() const { listener_.row(time_, strain_, state_); }

 private:
  /// Of an increment from the present time on.
  void tell_events(const PointReport& report, double to) const {
    for (const Event& event : report.events)
      listener_.event(event.kind, time_ + event.fraction * (to - time_));
  }

  const Material& material_;
  const PathListener& listener_;
  std::unique_ptr<LocalIntegrator> local_;
  double time_;
  SymmetricTensor strain_;
  PointState state_;
};

}  // namespace

void follow_path(const PointScene& scene, const Material& material, const PathListener& listener) {
  Walk point(scene, material, listener);
  point.tell();
  for (std::size_t segment = 0; segment + 1 < scene.time.size(); ++segment) {
    const double t0 = scene.time[segment], t1 = scene.time[segment + 1];
    const SymmetricTensor &e0 = scene.strain[segment], &e1 = scene.strain[segment + 1];
    for (int k = 1; k < scene.samples; ++k) {
      const double f = static_cast<double>(k) / scene.samples;
      point.advance(t0 + f * (t1 - t0), e0 + f * (e1 - e0));
      point.tell();
    }
    point.advance(t1, e1);
    point.tell();
  }
}

}  // namespace vitrum::app
