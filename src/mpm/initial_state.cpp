#include "mpm/initial_state.hpp"

namespace vitrum::mpm {
namespace {

PointState state_of(const Body& body, std::size_t i) {
  const Particles& p = body.particles;
  PointState s;
  s.elastic_strain = {p.elastic_strain[0][i], p.elastic_strain[1][i], p.elastic_strain[2][i],
                      p.elastic_strain[3][i]};
  for (const VariableInfo& v : body.material->variables()) {
    const auto k = static_cast<std::size_t>(v.variable);
    s.*variable_members[k] = p.variables[k][i];
  }
  return s;
}

void store(const PointState& s, Body& body, std::size_t i) {
  Particles& p = body.particles;
  const SymmetricTensor& e = s.elastic_strain;
  const std::array<double, 4> strain{e.rr, e.zz, e.tt, e.rz};
  for (std::size_t c = 0; c < 4; ++c) p.elastic_strain[c][i] = strain[c];
  for (const VariableInfo& v : body.material->variables()) {
    const auto k = static_cast<std::size_t>(v.variable);
    p.variables[k][i] = s.*variable_members[k];
  }
}

}  // namespace

void judge_initial_states(System& system) {
  StepRecord& record = system.record;
  record.elastic = 0.0;
  PointReport report;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    Body& body = system.bodies[n];
    const double specific_volume = 1.0 / body.material->parameters().elastic.density;
    for (std::size_t i = 0; i < body.particles.size; ++i) {
      PointState s = state_of(body, i);
      report.clear();
      body.material->judge(s, report);
      store(s, body, i);
      const double volume = body.particles.mass[i] * specific_volume;
      record.elastic += volume * body.material->stored_energy(s);
      const Dissipation& d = report.dissipation;
      record.dissipated += {volume * d.plastic, volume * d.damage, volume * d.fracture, volume * d.snap_back};
      for (std::size_t k = 0; k < report.event_count; ++k) record.events.push_back({n, i, report.events[k]});
    }
  }
  system.constitutive_events += static_cast<std::int64_t>(record.events.size());
}

}  // namespace vitrum::mpm
