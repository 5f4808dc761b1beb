// The rates of a phase: from displacements and velocities of nodes to strain, stress and forces.
#include <algorithm>

#include "integrators/grid/grid_system.hpp"
#include "integrators/grid/particle_chunks.hpp"
#include "integrators/grid/step_pacing.hpp"
#include "mpm/loads.hpp"
#include "mpm/stress.hpp"

namespace vitrum {

using mpm::Field;
using mpm::FiniteStrain;

void GridSystem::set_loads(double t) {
  mpm::set_loads(system_, t, t, mpm::Accelerations::none);
}

/// Displacement gradients at y. Whether any strain is not that of the last commit.
bool GridSystem::deform(double t, const double* y) {
  mpm::fill_field(system_, nodes_, y, mpm::boundary_ways(system_, start_time_, t), Field::velocity_0);
  mpm::gather_gradient(system_, gradients_);
  Flag changed;
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    const Deformation& d = deformations_[n];
    for_particles(system_, n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end && !changed.raised(); ++i) {
        const SymmetricTensor e = d.at(i).strain();
        if (e.rr != d.committed_strain[0][i] || e.zz != d.committed_strain[1][i] ||
            e.tt != d.committed_strain[2][i] || e.rz != d.committed_strain[3][i])
          changed.raise();
      }
    });
  }
  return changed.raised();
}

/// Where the particles are in the state deformed to. Patches turn by the antisymmetric part of the gradient:
/// what a couple acts on (contributions.hpp). (Phases are short; it is the turn to the second order.)
std::vector<mpm::Configuration> GridSystem::places() {
  std::vector<mpm::Configuration> bodies = mpm::configurations(system_);
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const Particles& p = system_.bodies[n].particles;
    const auto& g = deformations_[n].gradient;
    Motion& m = motions_[n];
    for_particles(system_, n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t c = 0; c < 2; ++c) m.position[c][i] = p.position[c][i] + m.displacement[c][i];
        m.turn[i] = p.turn[i] + 0.5 * (g[2][i] - g[1][i]);
      }
    });
    bodies[n] = {{m.position[0].data(), m.position[1].data()}, m.turn.data(), p.mirrored.data()};
  }
  return bodies;
}

/// Whether bodies touch in that state.
bool GridSystem::touch() {
  return system_.contact && system_.contact->evaluate(system_, places());
}

/// How particles move at y, for the power of tractions. Fills the nodal velocity.
std::vector<mpm::ParticleMotion> GridSystem::motions(const double* y) {
  mpm::fill_field(system_, nodes_, y + nodes_.size(), mpm::boundary_velocities(system_), Field::velocity_0);
  std::vector<mpm::ParticleGradient> targets(motions_.size());
  std::vector<mpm::ParticleMotion> list;
  for (std::size_t n = 0; n < motions_.size(); ++n) {
    Motion& m = motions_[n];
    for (std::size_t k = 0; k < 5; ++k) targets[n].gradient[k] = m.velocity_gradient[k].data();
    targets[n].value = {m.velocity[0].data(), m.velocity[1].data()};
    list.push_back({{m.velocity[0].data(), m.velocity[1].data()}, m.spin.data()});
  }
  mpm::gather_gradient(system_, targets);
  for (std::size_t n = 0; n < motions_.size(); ++n)
    mpm::set_spins(system_.bodies[n].particles, targets[n], motions_[n].spin);
  return list;
}

/// Strain since the last commit, in the frame of the committed state. The spin takes the end of the increment
/// to the frame of the present (as_committed), or back to that of the phase's start, where forces are
/// computed.
void GridSystem::set_increments(bool as_committed) {
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    Particles& p = system_.bodies[n].particles;
    const Deformation& d = deformations_[n];
    for_particles(system_, n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const FiniteStrain f = d.at(i);
        const SymmetricTensor before{d.committed_strain[0][i], d.committed_strain[1][i],
                                     d.committed_strain[2][i], d.committed_strain[3][i]};
        const SymmetricTensor change = rotate(f.strain() - before, rotation_by(d.committed_turn[i]));
        p.strain_increment[0][i] = change.rr, p.strain_increment[1][i] = change.zz;
        p.strain_increment[2][i] = change.tt, p.strain_increment[3][i] = change.rz;
        p.spin_increment[i] = (as_committed ? f.turn() : 0.0) - d.committed_turn[i];
      }
    });
  }
}

/// Nominal stress of the trial in place.
void GridSystem::try_stress(double t, bool changed) {
  if (changed) {
    mpm::try_stress(system_, trial_, std::max(0.0, t - committed_time_));
  } else {  // exactly the committed state, turned back to the phase's start
    for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
      Particles& p = system_.bodies[n].particles;
      const auto& from = trial_.of(n).elastic_strain;
      for_particles(system_, n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Rotation back = rotation_by(p.spin_increment[i]);
          auto& to = p.elastic_strain;
          const SymmetricTensor e = rotate({from[0][i], from[1][i], from[2][i], from[3][i]}, back);
          to[0][i] = e.rr, to[1][i] = e.zz, to[2][i] = e.tt, to[3][i] = e.rz;
        }
      });
      p.tried_stress = mpm::stress_of(system_.bodies[n]);
    }
  }
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    Particles& p = system_.bodies[n].particles;
    const Deformation& d = deformations_[n];
    for_particles(system_, n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const FiniteStrain f = d.at(i);
        auto& s = p.tried_stress;
        const auto P = f.nominal({s[0][i], s[1][i], s[2][i], s[3][i]});
        s[0][i] = P[0], s[3][i] = P[1], p.tried_stress_zr[i] = P[2], s[1][i] = P[3];
      }
    });
  }
}

bool GridSystem::rates(double t, const double* y, double* rates) {
  set_loads(t);
  const std::size_t n = nodes_.size();
  const bool changed = deform(t, y);
  std::fill(rates + 2 * n, rates + size(), 0.0);
  const bool touching = touch();
  std::vector<mpm::ParticleMotion> motion;
  if (system_.tractions) motion = motions(y);
  if (touching) system_.contact->load(system_, rates + 2 * n + (works_ ? 1 : 0));
  if (system_.tractions) system_.tractions->load(system_, t, places());
  {
    const mpm::Trial::Scope scope(system_, trial_);
    set_increments(false);
    try_stress(t, changed);
    mpm::scatter(system_, mpm::Scatter::force);
  }
  mpm::Contact::unload(system_);
  if (works_) mpm::fill_field(system_, nodes_, y + n, mpm::boundary_velocities(system_), Field::velocity_0);
  double power = mpm::accelerate(system_);
  if (system_.tractions) power += system_.tractions->power(motion);
  double* const accelerations = rates + size();
  reactions_.rates(system_, accelerations + n);
  std::copy(y + n, y + 2 * n, rates);
  mpm::read_field(system_, nodes_, Field::acceleration_0, accelerations);
  mass_.project(system_, accelerations, rates + n);
  if (works_) rates[2 * n] = power;
  not_finite_ = first_not_finite(rates, size());
  return !not_finite_;
}

}  // namespace vitrum
