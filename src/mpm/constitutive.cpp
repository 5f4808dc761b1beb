#include <fmt/format.h>

#include <utility>

#include "mpm/computation_error.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {
namespace {

constexpr std::size_t chunk_size = 256;

/// A null pointer for every column that is empty.
template <class Pointer, class Columns, std::size_t n>
void point(std::array<Pointer, n>& pointers, Columns& columns) {
  for (std::size_t k = 0; k < n; ++k) pointers[k] = columns[k].empty() ? nullptr : columns[k].data();
}

/// Columns of an increment that starts at `committed` and is stored in `p`, without its variables.
template <class Committed>
ParticleColumns columns_of(Particles& p, const Committed& committed) {
  ParticleColumns c;
  point(c.start_strain, committed.elastic_strain);
  point(c.start_variables, std::as_const(p.variables));
  point(c.elastic_strain, p.elastic_strain);
  point(c.stress, p.stress);
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

/// Takes all increments of a body; calls book(report) for each chunk in the order of the particles.
template <class Book>
void take_increments(System& system, std::size_t body_index, const ParticleColumns& columns, double duration,
                     Book&& book) {
  static thread_local std::vector<BatchReport>
      of_chunk;  // of the calling thread; workers write to its elements
  std::vector<BatchReport>& reports = of_chunk;
  const Body& body = system.bodies[body_index];
  const std::size_t size = body.particles.size, chunks = (size + chunk_size - 1) / chunk_size;
  if (reports.size() < chunks) reports.resize(chunks);
  system.team->for_each_chunk(chunks, [&](std::size_t k) {
    reports[k].clear();
    system.local->integrate(*body.material, columns, k * chunk_size, std::min(size, (k + 1) * chunk_size),
                            duration, reports[k]);
  });
  for (std::size_t k = 0; k < chunks; ++k)
    if (reports[k].failed) fail(system, body_index, *reports[k].failed, duration, reports[k].cause);
  for (std::size_t k = 0; k < chunks; ++k) {
    system.constitutive_solver += reports[k].solver;
    book(reports[k]);
  }
  system.constitutive_evaluations += static_cast<std::int64_t>(size);
}

}  // namespace

void update_stress(System& system, double duration) {
  StepRecord& record = system.record;
  record.elastic = 0.0;
  record.dissipated = {};
  record.events.clear();
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    Particles& p = system.bodies[n].particles;
    ParticleColumns columns = columns_of(p, p);
    point(columns.variables, p.variables);
    take_increments(system, n, columns, duration, [&](const BatchReport& report) {
      record.elastic += report.elastic;
      record.dissipated += report.dissipated;
      for (const ParticleEvent& e : report.events) record.events.push_back({n, e.particle, e.event});
    });
  }
  system.constitutive_events += static_cast<std::int64_t>(record.events.size());
}

void try_stress(System& system, const Trial& trial, double duration) {
  for (std::size_t n = 0; n < system.bodies.size(); ++n)
    take_increments(system, n, columns_of(system.bodies[n].particles, trial.of(n)), duration,
                    [](const BatchReport&) {});
}

void gather_tangents(System& system, const Trial& trial, double duration,
                     std::vector<std::vector<TangentEntries>>& tangents) {
  tangents.resize(system.bodies.size());
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    Body& body = system.bodies[n];
    const std::size_t size = body.particles.size;
    tangents[n].resize(size);
    const ParticleColumns columns = columns_of(body.particles, trial.of(n));
    system.team->for_each_chunk((size + chunk_size - 1) / chunk_size, [&](std::size_t k) {
      body.material->tangent(columns, k * chunk_size, std::min(size, (k + 1) * chunk_size), duration,
                             tangents[n].data());
    });
  }
}

}  // namespace vitrum::mpm
