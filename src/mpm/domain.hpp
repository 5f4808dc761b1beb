#pragma once
#include "mpm/system.hpp"

/// Domains that shape functions are averaged over (cpgimp): along r and z as long as the second moments of
/// the square that a particle was at the start, stretched and turned with it,
///   half_i = half_0 (F F^T)_ii^(1/2).
/// F F^T = exp(2 e) by the logarithmic strain e, which adds up in the frame that turns with the particle. A
/// crack is no stretch: particles that are cracked keep their strain. Domains end at the support that shape
/// functions have (Shape1<cpgimp>::largest_half), and at a thousandth of a cell.
namespace vitrum::mpm {

/// Gives the particles domains, unstretched.
void keep_domains(System& system);
inline bool have_domains(const Particles& p) {
  return !p.domain[0].empty();
}

/// Adds an increment, in the frame that turns from its start by `spin`, to the strain of particle i;
/// effective lengths tell which particles are cracked (empty: none).
void add_stretch(Particles& p, const std::vector<double>& effective_length, std::size_t i,
                 const SymmetricTensor& increment, double spin);
/// The same for all particles by Particles::strain_increment.
void add_stretches(System& system);
/// Brings domains up to date with the strains.
void update_domains(System& system);
/// Those of a trial: of the strains with Particles::strain_increment added, which are not kept.
void try_domains(System& system);

/// Particles whose domains would be longer than they can be.
std::size_t overstretched(const System& system);

}  // namespace vitrum::mpm
