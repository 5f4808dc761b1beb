#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "integrators/sundials/ark_system.hpp"
#include "mpm/loads.hpp"
#include "mpm/nodal_unknowns.hpp"

namespace vitrum::mpm {

/// What the particles weigh where nodes move them, M_ij = sum m_p N_i N_j over the nodal unknowns and, where
/// boundaries are driven, between these and held nodes. Particles that take the velocity changes q of nodes,
/// v_p += sum N_i q_i, gain p.q + q.M.q / 2 of kinetic energy, with p the momenta of nodes. Of particles that
/// are pressed far, M has a share of the sums of rows on its diagonal instead: what they gain less is lost
/// (docs/theory/adaptive.md).
class ConsistentMass {
 public:
  /// Elastic compressions, in the direction that is pressed most, from which on a share of a particle's mass
  /// is lumped, and all of it.
  static constexpr double lumped_from = 0.06, lumped_at = 0.15;

  /// For the particles' present positions and velocities and the grid's present masses.
  void assemble(const System& system, const NodalUnknowns& unknowns);

  /// How projected velocities change by what nodes give their particles, M q / m.
  void project(const System& system, const double* q, double* changes) const;
  /// Kinetic energy that particles gain by q at nodes that had velocities v, J (per radian or per metre).
  double gain(const double* q, const double* v) const;
  /// And what they gain besides by changes of the velocities of boundaries.
  double gain_by_boundaries(const double* q, std::span<const std::array<double, 2>> changes) const;

  /// The pattern of M times a matrix of that pattern, and the values of M diag(1/m) times it.
  sundials::SparsePattern times(const sundials::SparsePattern& pattern) const;
  void times(const sundials::SparsePattern& pattern, const std::vector<double>& values,
             const sundials::SparsePattern& product, std::vector<double>& result) const;

 private:
  struct Neighbour {
    std::int32_t unknown;
    double mass;
  };
  std::span<const Neighbour> row(std::size_t unknown) const {
    return {neighbours_.data() + start_[unknown], neighbours_.data() + start_[unknown + 1]};
  }
  double times_row(std::size_t unknown, const double* q) const {
    double sum = 0.0;
    for (const Neighbour& at : row(unknown)) sum += at.mass * q[at.unknown];
    return sum;
  }
  /// What a boundary's nodes share, by component.
  struct Held {
    std::array<double, 2> momentum{};
    std::array<std::vector<double>, 2> mass;  ///< by boundary
    std::vector<double> unknowns;             ///< by unknown
  };
  template <class Stencil>
  void add_held(const NodalUnknowns& unknowns, const Grid& grid, const Stencil& stencil, double mass,
                const std::array<double, 2>& velocity);

  std::vector<std::size_t> start_;  ///< of rows in `neighbours_`, and the end of the last
  std::vector<Neighbour> neighbours_;
  std::vector<double> per_mass_;         ///< 1 / m, by unknown
  std::vector<std::uint8_t> component_;  ///< by unknown
  std::vector<Held> held_;               ///< by boundary; empty: none is driven
};

}  // namespace vitrum::mpm
