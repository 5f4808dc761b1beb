#include "integrators/grid/grid_system.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "mpm/carried.hpp"
#include "mpm/centroids.hpp"

namespace vitrum {

using mpm::Field;

GridSystem::GridSystem(System& system, const ErrorScales& scales, double tolerance, double travel)
    : system_(system),
      scales_(scales),
      tolerance_(tolerance),
      works_(mpm::has_external_work(system)),
      tail_((works_ ? 1 : 0) +
            (system.contact ? mpm::Contact::rates_of_pair * system.contact->pairs().size() : 0)),
      travel_(travel),
      trial_(system, mpm::Trial::Moves::nodes),
      reactions_(system),
      deformations_(system.bodies.size()),
      motions_(system.contact || system.tractions ? system.bodies.size() : 0) {
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const std::size_t particles = system.bodies[n].particles.size;
    system.bodies[n].particles.keep_increments();
    mpm::ParticleGradient targets{};
    for (std::size_t k = 0; k < 5; ++k) {
      deformations_[n].gradient[k].assign(particles, 0.0);
      targets.gradient[k] = deformations_[n].gradient[k].data();
    }
    if (!motions_.empty()) {
      Motion& m = motions_[n];
      for (auto* columns : {&m.displacement, &m.position})
        for (std::vector<double>& column : *columns) column.assign(particles, 0.0);
      m.turn.assign(particles, 0.0);
      targets.value = {m.displacement[0].data(), m.displacement[1].data()};
      if (system.tractions) {
        for (std::vector<double>& column : m.velocity) column.assign(particles, 0.0);
        for (std::vector<double>& column : m.velocity_gradient) column.assign(particles, 0.0);
        m.spin.assign(particles, 0.0);
      }
    }
    gradients_.push_back(targets);
  }
}

void GridSystem::begin_phase() {
  set_loads(system_.time);
  held_at_start_ = held_committed_ = mpm::boundary_velocities(system_);
  system_.grid.move_boundaries(system_.time);
  if (system_.contact) system_.contact->part(system_);
  mpm::refresh_grid(system_, mpm::Storage::sorted);
  carried_work_ = mpm::carry_held(system_).work;
  mpm::find_centroids(system_);
  mpm::scatter(system_, mpm::Scatter::momentum);
  mpm::project_velocities(system_);
  mpm::number_unknowns(system_, nodes_);
  std::vector<mpm::CarrierPair> couplings;
  if (system_.contact) {
    system_.contact->settle(system_);
    couplings = system_.contact->foresee(system_, travel_ * system_.cell);
  }
  stiffness_.lay_out(system_, nodes_, couplings);
  mass_.assemble(system_, nodes_);
  pattern_ = mass_.times(stiffness_.pattern());
  diagonal_.resize(nodes_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    diagonal_[k] = static_cast<std::size_t>(std::find(pattern_.row.begin() + pattern_.column[k],
                                                      pattern_.row.begin() + pattern_.column[k + 1],
                                                      static_cast<std::int64_t>(k)) -
                                            pattern_.row.begin());
  start_velocity_.resize(nodes_.size());
  mpm::read_field(system_, nodes_, Field::velocity_0, start_velocity_.data());
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    const std::size_t particles = system_.bodies[n].particles.size;
    for (auto& column : deformations_[n].committed_strain) column.assign(particles, 0.0);
    deformations_[n].committed_turn.assign(particles, 0.0);
    rest_removed(n);
  }
  start_time_ = committed_time_ = system_.time;
  committed_tail_.assign(tail_, 0.0), deformation_ = driven_gain_ = 0.0;
  start_kinetic_ = mpm::kinetic_energy(system_);
  mean_mass_ = nodes_.size() == 0 ? 1.0
                                  : std::accumulate(nodes_.mass.begin(), nodes_.mass.end(), 0.0) /
                                        static_cast<double>(nodes_.size());
}

/// Particles that have left the computation do not move.
void GridSystem::rest_removed(std::size_t body) {
  const auto rest = [&](auto& columns) {
    for (std::vector<double>& column : columns)
      if (!column.empty())
        std::fill(column.begin() + static_cast<std::ptrdiff_t>(system_.bodies[body].present()), column.end(),
                  0.0);
  };
  rest(deformations_[body].gradient);
  if (motions_.empty()) return;
  Motion& m = motions_[body];
  rest(m.displacement), rest(m.velocity), rest(m.velocity_gradient);
}

void GridSystem::start(double* y) {
  std::fill(y, y + size() + nodes_.size(), 0.0);
  reactions_.begin(y + size() + nodes_.size());
  std::copy(start_velocity_.begin(), start_velocity_.end(), y + nodes_.size());
}

void GridSystem::carry(double from, double to, std::vector<double>& y) {
  const std::size_t all = size() + integrals();
  y.assign(all, 0.0);
  start(y.data());
  if (all == 0) return;
  const std::vector<double> still = y;
  std::vector<double> rate(all);
  for (const auto& [t, weight] : {std::pair(from, 1.0), {0.5 * (from + to), 4.0}, {to, 1.0}}) {
    rates(t, still.data(), rate.data());
    for (std::size_t k = 0; k < all; ++k) y[k] += weight * rate[k];
  }
  for (double& integral : y) integral *= (to - from) / 6.0;
}

}  // namespace vitrum
