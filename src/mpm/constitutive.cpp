#include <fmt/format.h>

#include "mpm/computation_error.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {
namespace {

constexpr std::size_t chunk_size = 256;

template <std::size_t n>
std::array<double*, n> pointers(std::array<std::vector<double>, n>& columns) {
  std::array<double*, n> result{};
  for (std::size_t k = 0; k < n; ++k) result[k] = columns[k].empty() ? nullptr : columns[k].data();
  return result;
}

ParticleColumns columns_of(Particles& p) {
  ParticleColumns c;
  c.elastic_strain = pointers(p.elastic_strain);
  c.stress = pointers(p.stress);
  c.variables = pointers(p.variables);
  for (std::size_t k = 0; k < 4; ++k) c.strain_increment[k] = p.strain_increment[k].data();
  c.spin_increment = p.spin_increment.data();
  c.mass = p.mass.data();
  return c;
}

[[noreturn]] void fail(const System& system, std::size_t body, std::size_t particle, double duration,
                       const std::string& cause) {
  const Particles& p = system.bodies[body].particles;
  throw PointFailure(
      fmt::format(
          "the local equations of body '{}', particle {} at ({:.6g}, {:.6g}) m could not be integrated over "
          "{:.4g} s: {}; try a larger constitutive.rtol, a smaller step, or constitutive.method = "
          "\"closed-form\"",
          system.bodies[body].name, p.identity[particle], p.position[0][particle], p.position[1][particle],
          duration, cause),
      body, particle, duration);
}

}  // namespace

void update_stress(System& system, double duration) {
  system.record.elastic = 0.0;
  system.record.dissipated = {};
  system.record.events.clear();
  static thread_local std::vector<BatchReport>
      of_chunk;  // of the calling thread; workers write to its elements
  std::vector<BatchReport>& reports = of_chunk;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    Body& body = system.bodies[n];
    const std::size_t size = body.particles.size, chunks = (size + chunk_size - 1) / chunk_size;
    const ParticleColumns columns = columns_of(body.particles);
    if (reports.size() < chunks) reports.resize(chunks);
    system.team->for_each_chunk(chunks, [&](std::size_t k) {
      reports[k].clear();
      system.local->integrate(*body.material, columns, k * chunk_size, std::min(size, (k + 1) * chunk_size),
                              duration, reports[k]);
    });
    for (std::size_t k = 0; k < chunks; ++k)
      if (reports[k].failed) fail(system, n, *reports[k].failed, duration, reports[k].cause);
    for (std::size_t k = 0; k < chunks; ++k) {
      system.record.elastic += reports[k].elastic;
      system.constitutive_solver += reports[k].solver;
      system.record.dissipated += reports[k].dissipated;
      for (const ParticleEvent& e : reports[k].events)
        system.record.events.push_back({n, e.particle, e.event});
    }
    system.constitutive_evaluations += static_cast<std::int64_t>(size);
  }
  system.constitutive_events += static_cast<std::int64_t>(system.record.events.size());
}

}  // namespace vitrum::mpm
