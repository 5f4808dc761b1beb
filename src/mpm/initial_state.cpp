#include "mpm/initial_state.hpp"

#include "mpm/crack_length.hpp"
#include "mpm/point.hpp"

namespace vitrum::mpm {
void judge_initial_states(System& system) {
  StepRecord& record = system.record;
  record.elastic = 0.0;
  PointReport report;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    Body& body = system.bodies[n];
    const double specific_volume = 1.0 / body.material->density();
    for (std::size_t i = 0; i < body.particles.size; ++i) {
      PointState s = point_of(body, i);
      report.clear();
      body.material->judge(s, report);
      put_point(s, body, i);
      const double volume = body.particles.mass[i] * specific_volume;
      record.elastic += volume * body.material->stored_energy(s);
      const Dissipation& d = report.dissipation;
      record.dissipated += {volume * d.plastic, volume * d.damage, volume * d.fracture, volume * d.snap_back};
      for (const Event& event : report.events) record.events.push_back({n, i, event});
    }
  }
  share_cracks(system);
  system.constitutive_events += static_cast<std::int64_t>(record.events.size());
}

}  // namespace vitrum::mpm
