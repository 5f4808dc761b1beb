#include "mpm/domain.hpp"

#include <algorithm>
#include <cmath>

namespace vitrum::mpm {
namespace {

/// (F F^T)_ii^(1/2) of e, for e < 350.
std::array<double, 2> extents(const SymmetricTensor& e) {
  const double across = e.rr - e.zz, size = std::hypot(across, 2.0 * e.rz);
  const double share = size > 1e-4 ? std::sinh(size) / size : 1.0 + size * size / 6.0;
  const double middle = std::exp(e.rr + e.zz), even = std::cosh(size);
  return {std::sqrt(middle * std::max(0.0, even + across * share)),
          std::sqrt(middle * std::max(0.0, even - across * share))};
}

SymmetricTensor stretch_of(const Particles& p, std::size_t i) {
  return {p.stretch[0][i], p.stretch[1][i], 0.0, p.stretch[2][i]};
}

/// With an increment, in the axes of space; of a cracked particle without.
SymmetricTensor stretched(const Particles& p, const std::vector<double>& effective_length, std::size_t i,
                          const SymmetricTensor& increment, double spin) {
  SymmetricTensor e = stretch_of(p, i);
  if (effective_length.empty() || !(effective_length[i] > 0.0)) e += increment;
  return rotate(e, rotation_by(spin));
}

void set_domain(Body& body, std::size_t i, const SymmetricTensor& stretch, double cell) {
  constexpr double shortest = 1e-3;
  const std::array<double, 2> extent = extents(stretch);
  for (std::size_t c = 0; c < 2; ++c)
    body.particles.domain[c][i] = std::min(Shape1<ShapeKind::cpgimp>::largest_half * cell,
                                           std::max(shortest * cell, body.particle_half_size * extent[c]));
}

/// Calls f(body, particle) for all that have domains, on all threads.
template <class F>
void for_domains(System& system, F&& f) {
  constexpr std::size_t most = 256;
  for (Body& body : system.bodies) {
    const std::size_t size = body.particles.size;
    if (!have_domains(body.particles)) continue;
    system.team->for_each_chunk((size + most - 1) / most, [&](std::size_t k) {
      for (std::size_t i = k * most; i < std::min(size, (k + 1) * most); ++i) f(body, i);
    });
  }
}

SymmetricTensor increment_of(const Particles& p, std::size_t i) {
  return tensor_at(p.strain_increment, i);
}

}  // namespace

void keep_domains(System& system) {
  for (Body& body : system.bodies) {
    Particles& p = body.particles;
    for (auto& column : p.stretch) column.assign(p.size, 0.0);
    for (auto& column : p.domain) column.assign(p.size, body.particle_half_size);
  }
}

void add_stretch(Particles& p, const std::vector<double>& effective_length, std::size_t i,
                 const SymmetricTensor& increment, double spin) {
  const SymmetricTensor e = stretched(p, effective_length, i, increment, spin);
  p.stretch[0][i] = e.rr, p.stretch[1][i] = e.zz, p.stretch[2][i] = e.rz;
}

void add_stretches(System& system) {
  for (Body& body : system.bodies) {
    Particles& p = body.particles;
    if (!have_domains(p)) continue;
    const std::vector<double>& length = body.column("effective_length");
    for (std::size_t i = 0; i < p.size; ++i)
      add_stretch(p, length, i, increment_of(p, i), p.spin_increment[i]);
  }
}

void update_domains(System& system) {
  for_domains(system, [&](Body& body, std::size_t i) {
    set_domain(body, i, stretch_of(body.particles, i), system.cell);
  });
}

void try_domains(System& system) {
  for_domains(system, [&](Body& body, std::size_t i) {
    const Particles& p = body.particles;
    set_domain(body, i,
               stretched(p, body.column("effective_length"), i, increment_of(p, i), p.spin_increment[i]),
               system.cell);
  });
}

std::size_t overstretched(const System& system) {
  std::size_t count = 0;
  for (const Body& body : system.bodies)
    for (std::size_t i = 0; have_domains(body.particles) && i < body.particles.size; ++i) {
      const std::array<double, 2> extent = extents(stretch_of(body.particles, i));
      if (body.particle_half_size * std::max(extent[0], extent[1]) >
          Shape1<ShapeKind::cpgimp>::largest_half * system.cell)
        ++count;
    }
  return count;
}

}  // namespace vitrum::mpm
