#pragma once
#include <span>

#include "integrators/sundials/ark_system.hpp"
#include "mpm/nodal_unknowns.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {

/// The stiffness of the particles over the nodal unknowns, K = sum V B^T T B, in compressed columns. Its
/// pattern is fixed as long as the particles stay where they are.
class Stiffness {
 public:
  /// Lays the pattern out anew for the particles' present positions.
  void lay_out(const System& system, const NodalUnknowns& unknowns);

  const sundials::SparsePattern& pattern() const { return pattern_; }
  /// Place of each diagonal entry.
  const std::vector<std::int64_t>& diagonal() const { return diagonal_; }

  /// Values of K, N/m (per radian or per metre). gradients: displacement gradient of the trial in place, by
  /// body; tangents: d stress / d strain of every particle, by body. Volumes are those of the trial's elastic
  /// strain.
  void assemble(const System& system, const NodalUnknowns& unknowns,
                std::span<const ParticleGradient> gradients,
                std::span<const std::vector<TangentEntries>> tangents, std::vector<double>& values) const;

 private:
  /// Neighbours of a node are told by their offset in [-2, 2]^2.
  static constexpr int reach = 2, offsets = 25;
  struct Links {
    std::uint32_t mask = 0;                         ///< offsets that share a particle
    std::array<std::uint8_t, offsets> first_row{};  ///< rows of a column before those of an offset
  };
  std::vector<Links> links_;  ///< by node
  sundials::SparsePattern pattern_;
  std::vector<std::int64_t> diagonal_;
};

}  // namespace vitrum::mpm
