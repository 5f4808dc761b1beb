#include "integrators/grid/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "integrators/sundials/klu_factors.hpp"
#include "mpm/centroids.hpp"
#include "mpm/computation_error.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/loads.hpp"
#include "mpm/nodal_unknowns.hpp"
#include "mpm/point.hpp"
#include "mpm/stiffness.hpp"
#include "mpm/stress.hpp"
#include "mpm/tractions.hpp"
#include "mpm/transfer.hpp"

namespace vitrum {
namespace {

using mpm::Field;

double stored_energy(const System& system) {
  double sum = 0.0;
  for (const Body& body : system.bodies)
    for (std::size_t i = 0; i < body.on_grid(); ++i)
      sum += body.particles.mass[i] / body.material->density() *
             body.material->stored_energy(mpm::point_of(body, i));
  return sum;
}

/// Particles without velocity as long as it exists, so that forces alone reach the nodes, and other bodies
/// off the grid.
class AtRest {
 public:
  AtRest(System& system, const std::vector<bool>& relaxed) : system_(system) {
    for (std::size_t n = 0; n < relaxed.size(); ++n) {
      Body& body = system.bodies[n];
      if (!relaxed[n]) body.coasting.emplace();
      velocities_.push_back(body.particles.velocity);
      for (std::vector<double>& column : body.particles.velocity)
        std::fill(column.begin(), column.end(), 0.0);
    }
  }
  ~AtRest() {
    for (std::size_t n = 0; n < velocities_.size(); ++n) {
      Particles& p = system_.bodies[n].particles;
      p.velocity.swap(velocities_[n]);
      for (std::vector<double>& column : p.strain_increment) column = {};
      p.spin_increment = {};
      system_.bodies[n].coasting.reset();
    }
    system_.grid_is_stale = true;
  }
  AtRest(const AtRest&) = delete;
  AtRest& operator=(const AtRest&) = delete;

 private:
  System& system_;
  std::vector<VectorColumns> velocities_;
};

/// Strains of a small displacement of the nodes, added to the bodies' where they stand.
void strain_elastically(System& system, std::span<const mpm::ParticleGradient> gradients) {
  mpm::gather_gradient(system, gradients);
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    TensorColumns& strain = system.bodies[n].particles.elastic_strain;
    const auto& [rr, rz, zr, zz, tt] = gradients[n].gradient;
    for (std::size_t i = 0; i < system.bodies[n].on_grid(); ++i)
      put_tensor(strain, i,
                 tensor_at(strain, i) + SymmetricTensor{rr[i], zz[i], tt[i], 0.5 * (rz[i] + zr[i])});
  }
}

/// The nodes' equations of equilibrium with the particles where they stand.
class Equilibrium {
 public:
  Equilibrium(System& system, double inertia)
      : system_(system), inertia_(inertia), columns_(system.bodies.size()), gradients_(system.bodies.size()) {
    system.grid_is_stale = true;
    mpm::refresh_grid(system);
    mpm::find_centroids(system);
    mpm::scatter(system, mpm::Scatter::momentum);
    mpm::project_velocities(system);
    mpm::number_unknowns(system, nodes_);
    stiffness_.lay_out(system, nodes_);
    for (std::size_t n = 0; n < columns_.size(); ++n) {
      system.bodies[n].particles.keep_increments();
      for (std::size_t k = 0; k < 5; ++k) {
        columns_[n][k].resize(system.bodies[n].particles.size);
        gradients_[n].gradient[k] = columns_[n][k].data();
      }
    }
  }

  /// One of Newton's iterations. Energy that the forces could release, J (per radian or per metre); finds the
  /// displacements that would.
  double solve() {
    const std::size_t n = nodes_.size();
    if (n == 0) return 0.0;
    std::vector<double> force = forces(), values;
    displacement_ = force;
    assemble(values);
    for (std::size_t k = 0; k < n; ++k)
      values[static_cast<std::size_t>(stiffness_.diagonal()[k])] += inertia_ * nodes_.mass[k];
    sundials::KluFactors factors(stiffness_.pattern());
    if (factors.factor(values.data()) != sundials::KluFactors::Outcome::done)
      throw ComputationError("relaxation: the stiffness of the bodies cannot be factored");
    factors.solve(displacement_.data());
    return 0.5 * std::inner_product(force.begin(), force.end(), displacement_.begin(), 0.0);
  }

  void strain() {
    const mpm::OfBoundaries still(system_.grid.boundaries().size());
    mpm::fill_field(system_, nodes_, displacement_.data(), still, Field::velocity_0);
    strain_elastically(system_, gradients_);
  }

 private:
  std::vector<double> forces() {
    mpm::Contact::unload(system_);
    if (system_.tractions) system_.tractions->load(system_, system_.time, mpm::configurations(system_));
    mpm::scatter(system_, mpm::Scatter::force);
    mpm::Contact::unload(system_);
    std::vector<double> force(nodes_.size());
    mpm::read_field(system_, nodes_, Field::force_0, force.data());
    for (std::size_t k = 0; k < force.size(); ++k)
      force[k] += nodes_.mass[k] * system_.gravity[nodes_.component[k]];
    return force;
  }

  void assemble(std::vector<double>& values) {
    for (auto& body : columns_)
      for (std::vector<double>& column : body) std::fill(column.begin(), column.end(), 0.0);
    mpm::Trial trial(system_, mpm::Trial::Moves::nodes);
    std::vector<std::vector<TangentEntries>> tangents;
    const mpm::Trial::Scope scope(system_, trial);
    constexpr double instant = 1e-12;  // s: too short to flow, relax or break
    mpm::gather_tangents(system_, trial, instant, tangents);
    stiffness_.assemble(system_, nodes_, gradients_, tangents, values);
  }

  System& system_;
  double inertia_;
  mpm::NodalUnknowns nodes_;
  mpm::Stiffness stiffness_;
  std::vector<std::array<std::vector<double>, 5>> columns_;
  std::vector<mpm::ParticleGradient> gradients_;
  std::vector<double> displacement_;
};

}  // namespace

Relaxation relax(System& system, const std::vector<bool>& relaxed) {
  mpm::set_loads(system, system.time, system.time, mpm::Accelerations::none);
  system.grid.move_boundaries(system.time);
  const AtRest at_rest(system, relaxed);
  // The slowest motion of a body takes a thousand crossings by waves, or more: inertia is a trace beside it.
  double size = 0.0, speed = 0.0;
  for (const Body& body : system.bodies) {
    speed = std::max(speed, body.material->wave_speed());
    for (const std::vector<double>& x : body.particles.position) {
      const auto [least, most] = std::minmax_element(x.begin(), x.end());
      if (least != x.end()) size = std::max(size, *most - *least + system.cell);
    }
  }
  const double inertia = 1e-8 * speed * speed / (size * size);
  constexpr int most = 30;
  constexpr double enough = 1e-11, negligible = 1e-8;
  Relaxation result;
  Equilibrium equilibrium(system, inertia);
  double stored = 0.0;  // the most on the way: equilibrium may be the state without stress
  double before = std::numeric_limits<double>::infinity();
  for (; result.iterations < most; ++result.iterations) {
    const double energy = equilibrium.solve();
    stored = std::max(stored, stored_energy(system));
    result.residual = stored > 0.0 ? energy / stored : energy;
    if (!std::isfinite(result.residual)) break;
    // Motions softer than the trace of inertia go slowly; what is left of them may be too little to matter.
    const bool creeps = result.residual <= negligible && result.residual > 0.5 * before;
    if (result.residual <= enough || creeps) return result;
    before = result.residual;
    equilibrium.strain();
  }
  throw ComputationError(fmt::format(
      "relaxation has found no equilibrium in {} iterations: the forces left could release {:.3g} {}; a body "
      "whose stress or loads do not balance must be held by boundaries",
      most, result.residual, stored > 0.0 ? "of the energy stored" : "J where none is stored"));
}

}  // namespace vitrum
