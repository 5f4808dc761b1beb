#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "mpm/computation_error.hpp"
#include "mpm/crack_length.hpp"
#include "mpm/stress_update.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {
namespace {

constexpr std::size_t chunk_size = 256;

/// A null pointer for every column that is empty.
template <class Pointers, class Columns>
void point(Pointers& pointers, Columns& columns) {
  for (std::size_t k = 0; k < columns.size(); ++k)
    pointers[k] = columns[k].empty() ? nullptr : columns[k].data();
}
template <class Pointer, class Columns>
void point(VariableColumns<Pointer>& pointers, Columns& columns) {
  for (auto& column : columns) pointers.push_back(column.data());
}

/// Columns of an increment that starts at `committed` and is stored in `p`, without its variables.
template <class Committed>
ParticleColumns columns_of(Particles& p, const Committed& committed) {
  ParticleColumns c;
  point(c.start_strain, committed.elastic_strain);
  point(c.start_variables, std::as_const(p.variables));
  point(c.elastic_strain, p.elastic_strain);
  point(c.stress, p.tried_stress);
  for (std::size_t k = 0; k < 4; ++k) c.strain_increment[k] = p.strain_increment[k].data();
  c.spin_increment = p.spin_increment.data();
  c.mass = p.mass.data();
  return c;
}

/// The failure that a report tells of.
[[noreturn]] void fail(const System& system, std::size_t body, const BatchReport& report, double duration) {
  const Particles& p = system.bodies[body].particles;
  const std::size_t particle = *report.failed;
  throw PointFailure(
      fmt::format(
          "the local equations of body '{}', particle {} at ({:.6g}, {:.6g}) m could not be integrated over "
          "{:.4g} s: {}; try another constitutive.rtol, a smaller step, or constitutive.method = "
          "\"closed-form\"",
          system.bodies[body].name, p.identity[particle], p.position[0][particle], p.position[1][particle],
          duration, report.cause),
      body, particle, report.failed_increment, duration);
}

/// Reports of the calling thread, to be cleared by who writes to them: what one thread has written, another
/// one fetches slowly.
std::vector<BatchReport>& reports_of(std::size_t count) {
  static thread_local std::vector<BatchReport> reports;
  if (reports.size() < count) reports.resize(count);
  return reports;
}

std::vector<BriefReport>& brief_reports_of(std::size_t count) {
  static thread_local std::vector<BriefReport> reports;
  if (reports.size() < count) reports.resize(count);
  return reports;
}

/// Takes all increments of a body; calls book(report) for each chunk in the order of the particles.
template <class Book>
void take_increments(System& system, std::size_t body_index, const ParticleColumns& columns, double duration,
                     Book&& book) {
  const Body& body = system.bodies[body_index];
  const std::size_t size = body.present(), chunks = (size + chunk_size - 1) / chunk_size;
  std::vector<BatchReport>& reports = reports_of(chunks);
  system.team->for_each_chunk(chunks, [&](std::size_t k) {
    reports[k].clear();
    system.local->integrate(*body.material, columns, k * chunk_size, std::min(size, (k + 1) * chunk_size),
                            duration, reports[k]);
  });
  for (std::size_t k = 0; k < chunks; ++k)
    if (reports[k].failed) fail(system, body_index, reports[k], duration);
  for (std::size_t k = 0; k < chunks; ++k) {
    system.constitutive_solver += reports[k].solver;
    book(reports[k]);
  }
  system.constitutive_evaluations += static_cast<std::int64_t>(size);
}

/// Columns of increments that are committed.
ParticleColumns committing_columns(Particles& p) {
  ParticleColumns columns = columns_of(p, p);
  point(columns.variables, p.variables);
  return columns;
}

void open_record(StepRecord& record) {
  record.elastic = 0.0;
  record.dissipated = {};
  record.events.clear();
  record.removed = 0.0;
  record.left.clear();
}

/// All but the elastic energy.
void enter(StepRecord& record, std::size_t body, const BatchReport& report) {
  record.dissipated += report.dissipated;
  for (const ParticleEvent& e : report.events) record.events.push_back({body, e.particle, e.event});
}

/// Puts the events of a step in an order that depends neither on how particles are stored nor on threads.
void order_events(System& system) {
  const auto identity = [&](const BodyEvent& e) {
    return system.bodies[e.body].particles.identity[e.particle];
  };
  std::ranges::stable_sort(system.record.events, [&](const BodyEvent& a, const BodyEvent& b) {
    return std::tuple(a.event.fraction, a.body, identity(a)) <
           std::tuple(b.event.fraction, b.body, identity(b));
  });
}

/// The columns from `place` on, of an increment that is committed: ends and starts are the same arrays.
void advance(ParticleColumns& c, std::size_t place) {
  const auto all = [place](auto& pointers) {
    for (auto& pointer : pointers)
      if (pointer != nullptr) pointer += place;
  };
  all(c.start_strain), all(c.start_variables), all(c.elastic_strain), all(c.stress), all(c.variables);
  c.mass += place;
}

/// Columns of a chunk whose particles lie apart, brought together for an increment that is committed.
class Collected {
 public:
  Collected() {}  // filled, not cleared

  ParticleColumns from(const ParticleColumns& columns, const Chunk& chunk) {
    ParticleColumns c = columns;
    double(*free)[Chunk::capacity] = values_;
    for_each(c, [&](double*& column) {
      double* copy = *free++;
      for (std::size_t k = 0; k < chunk.size(); ++k) copy[k] = column[chunk.place(k)];
      column = copy;
    });
    for (std::size_t k = 0; k < 4; ++k) c.start_strain[k] = c.elastic_strain[k];
    for (std::size_t k = 0; k < c.variables.size(); ++k) c.start_variables[k] = c.variables[k];
    for (std::size_t k = 0; k < chunk.size(); ++k) mass_[k] = columns.mass[chunk.place(k)];
    c.mass = mass_;
    return c;
  }

  void put_back(ParticleColumns columns, const Chunk& chunk) const {
    const double(*next)[Chunk::capacity] = values_;
    for_each(columns, [&](double* column) {
      const double* copy = *next++;
      for (std::size_t k = 0; k < chunk.size(); ++k) column[chunk.place(k)] = copy[k];
    });
  }

 private:
  /// What an increment changes.
  template <class Call>
  static void for_each(ParticleColumns& c, Call&& call) {
    const auto all = [&](auto& columns) {
      for (auto& column : columns)
        if (column != nullptr) call(column);
    };
    all(c.elastic_strain), all(c.stress), all(c.variables);
  }

  double values_[8 + most_columns][Chunk::capacity];
  double mass_[Chunk::capacity];
};

}  // namespace

StressUpdate::StressUpdate(System& system, double duration)
    : system_(system),
      duration_(duration),
      reports_(reports_of(system.grid.tiles().size() * system.bodies.size())),
      brief_(brief_reports_of(system.grid.tiles().size() * system.bodies.size())) {
  for (Body& body : system.bodies) columns_.push_back(committing_columns(body.particles));
}

void StressUpdate::start(std::size_t tile) {
  const std::size_t bodies = columns_.size();
  for (std::size_t k = tile * bodies; k < (tile + 1) * bodies; ++k) reports_[k].clear();
}

void StressUpdate::take(std::size_t tile, std::size_t body, const Chunk& chunk,
                        const ChunkIncrements& increments) {
  BatchReport& report = reports_[tile * columns_.size() + body];
  if (report.failed) return;  // the step fails, whatever comes after
  ParticleColumns c = columns_[body];
  for (std::size_t k = 0; k < 4; ++k) c.strain_increment[k] = increments.strain[k];
  c.spin_increment = increments.spin;
  const std::size_t known_events = report.events.size();
  const auto integrate = [&](const ParticleColumns& columns) {
    system_.local->integrate(*system_.bodies[body].material, columns, 0, chunk.size(), duration_, report);
  };
  if (chunk.contiguous()) {
    advance(c, chunk.place(0));
    integrate(c);
  } else {
    // Sums over a chunk must not depend on how its particles lie.
    Collected collected;
    integrate(collected.from(c, chunk));
    collected.put_back(c, chunk);
  }
  for (std::size_t k = known_events; k < report.events.size(); ++k)
    report.events[k].particle = chunk.place(report.events[k].particle);
  if (report.failed) report.failed = chunk.place(*report.failed);
}

void StressUpdate::finish(std::size_t tile) {
  const std::size_t bodies = columns_.size();
  for (std::size_t k = tile * bodies; k < (tile + 1) * bodies; ++k)
    brief_[k] = {reports_[k].elastic, reports_[k].tells_more()};
}

void StressUpdate::book() {
  const std::size_t bodies = columns_.size(), reports = system_.grid.tiles().size() * bodies;
  for (std::size_t k = 0; k < reports; ++k)
    if (brief_[k].more && reports_[k].failed) fail(system_, k % bodies, reports_[k], duration_);
  open_record(system_.record);
  for (std::size_t k = 0; k < reports; ++k) {
    system_.record.elastic += brief_[k].elastic;
    if (!brief_[k].more) continue;
    system_.constitutive_solver += reports_[k].solver;
    enter(system_.record, k % bodies, reports_[k]);
  }
  order_events(system_);
  share_cracks(system_);
  for (const Body& body : system_.bodies)
    system_.constitutive_evaluations += static_cast<std::int64_t>(body.on_grid());
  system_.constitutive_events += static_cast<std::int64_t>(system_.record.events.size());
}

void update_stress(System& system, double duration) {
  open_record(system.record);
  for (std::size_t n = 0; n < system.bodies.size(); ++n)
    take_increments(system, n, committing_columns(system.bodies[n].particles), duration,
                    [&](const BatchReport& report) {
                      system.record.elastic += report.elastic;
                      enter(system.record, n, report);
                    });
  order_events(system);
  share_cracks(system);
  system.constitutive_events += static_cast<std::int64_t>(system.record.events.size());
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
    const std::size_t size = body.present();
    tangents[n].resize(body.particles.size);
    const ParticleColumns columns = columns_of(body.particles, trial.of(n));
    system.team->for_each_chunk((size + chunk_size - 1) / chunk_size, [&](std::size_t k) {
      body.material->tangent(columns, k * chunk_size, std::min(size, (k + 1) * chunk_size), duration,
                             tangents[n].data());
    });
  }
}

}  // namespace vitrum::mpm
