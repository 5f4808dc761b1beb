#pragma once
#include <span>
#include <unordered_map>

#include "integrators/sundials/ark_system.hpp"
#include "mpm/contact/patch.hpp"
#include "mpm/nodal_unknowns.hpp"
#include "mpm/stencil_nodes.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {

/// The stiffness of the particles over the nodal unknowns, K = sum V B^T T B, in compressed columns. Its
/// pattern is fixed as long as the particles stay where they are.
class Stiffness {
 public:
  /// Of a particle, by its place.
  static std::uint64_t key_of(std::size_t body, std::size_t particle) {
    return (static_cast<std::uint64_t>(body) << 32) | particle;
  }
  /// Lays the pattern out anew for the particles' present positions. couplings: particles of different
  /// velocity fields that may act on each other.
  void lay_out(const System& system, const NodalUnknowns& unknowns,
               std::span<const CarrierPair> couplings = {});

  const sundials::SparsePattern& pattern() const { return pattern_; }
  /// Place of each diagonal entry.
  const std::vector<std::int64_t>& diagonal() const { return diagonal_; }

  /// Values of K, N/m (per radian or per metre). gradients: displacement gradient of the trial in place, by
  /// body; tangents: d stress / d strain of every particle, by body. Volumes are those of the trial's elastic
  /// strain.
  void assemble(const System& system, const NodalUnknowns& unknowns,
                std::span<const ParticleGradient> gradients,
                std::span<const std::vector<TangentEntries>> tangents, std::vector<double>& values) const;
  /// Subtracts what forces on particles change by as these turn: by particle the derivative to its turn, N.
  void add_followers(const System& system, const NodalUnknowns& unknowns,
                     const std::unordered_map<std::uint64_t, Vector>& by_turn,
                     std::vector<double>& values) const;
  /// Adds a spring between two particles, which pulls along one direction when it is stretched along another.
  /// Of particles that `lay_out` was not told of, what has no place in the pattern is left out.
  void add(const CarrierPair& pair, const Vector& force, const Vector& stretch, double size,
           std::vector<double>& values) const;

 private:
  struct Links {
    std::uint64_t mask = 0;                                   ///< offsets that share a particle
    std::array<std::uint8_t, neighbour_offsets> first_row{};  ///< rows of a column before those of an offset
  };
  /// Share of a particle's motion that an unknown has.
  struct Share {
    std::int64_t unknown;
    std::uint8_t component;
    double weight;
  };
  void list_shares(const System& system, const NodalUnknowns& unknowns,
                   std::span<const CarrierPair> couplings);
  std::vector<std::vector<std::int64_t>> coupled_rows(std::size_t unknowns,
                                                      std::span<const CarrierPair> couplings) const;
  std::unordered_map<std::uint64_t, std::vector<Share>> shares_;  ///< of coupled particles
  std::vector<Links> links_;                                      ///< by node
  sundials::SparsePattern pattern_;
  std::vector<std::int64_t> diagonal_;
};

}  // namespace vitrum::mpm
