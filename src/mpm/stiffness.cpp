#include "mpm/stiffness.hpp"

#include <algorithm>
#include <optional>

#include "mpm/between_centroids.hpp"
#include "mpm/finite_strain.hpp"

namespace vitrum::mpm {

void Stiffness::list_shares(const System& system, const NodalUnknowns& unknowns,
                            std::span<const CarrierPair> couplings) {
  shares_.clear();
  for (const CarrierPair& pair : couplings)
    shares_[key_of(pair.body_a, pair.particle_a)], shares_[key_of(pair.body_b, pair.particle_b)];
  if (shares_.empty()) return;
  dispatch(system.grid, [&]<ShapeKind kind, bool>() {
    for_stencils<kind>(system, [&](std::size_t n, std::size_t i, const auto& stencil) {
      const auto entry = shares_.find(key_of(n, i));
      if (entry == shares_.end()) return;
      for (const StencilNode& s : stencil)
        for (std::size_t c = 0; c < 2 && s.node >= 0; ++c)
          if (const std::int32_t unknown = unknowns.number[2 * static_cast<std::size_t>(s.node) + c];
              unknown >= 0)
            entry->second.push_back({unknown, static_cast<std::uint8_t>(c), s.parity[c] * s.value});
    });
  });
}

/// The rows by which couplings lengthen the columns: those of the other particle's unknowns.
std::vector<std::vector<std::int64_t>> Stiffness::coupled_rows(std::size_t unknowns,
                                                               std::span<const CarrierPair> couplings) const {
  std::vector<std::vector<std::int64_t>> rows(couplings.empty() ? 0 : unknowns);
  for (const CarrierPair& pair : couplings)
    for (const Share& a : shares_.at(key_of(pair.body_a, pair.particle_a)))
      for (const Share& b : shares_.at(key_of(pair.body_b, pair.particle_b))) {
        rows[static_cast<std::size_t>(a.unknown)].push_back(b.unknown);
        rows[static_cast<std::size_t>(b.unknown)].push_back(a.unknown);
      }
  for (std::vector<std::int64_t>& column : rows) {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
  }
  return rows;
}

void Stiffness::add(const CarrierPair& pair, const Vector& force, const Vector& stretch, double size,
                    std::vector<double>& values) const {
  struct Entry {
    std::int64_t unknown;
    double force, stretch;
  };
  std::vector<Entry> entries;
  const auto list = [&](std::size_t body, std::size_t particle, double sign) {
    if (const auto shares = shares_.find(key_of(body, particle)); shares != shares_.end())
      for (const Share& s : shares->second)
        entries.push_back(
            {s.unknown, sign * s.weight * force[s.component], sign * s.weight * stretch[s.component]});
  };
  list(pair.body_a, pair.particle_a, -1.0), list(pair.body_b, pair.particle_b, 1.0);
  for (const Entry& column : entries) {
    const auto k = static_cast<std::size_t>(column.unknown);
    const auto first = pattern_.row.begin() + pattern_.column[k],
               last = pattern_.row.begin() + pattern_.column[k + 1];
    for (const Entry& row : entries)
      if (const auto at = std::find(first, last, row.unknown); at != last)
        values[static_cast<std::size_t>(at - pattern_.row.begin())] += size * row.force * column.stretch;
  }
}

void Stiffness::add_followers(const System& system, const NodalUnknowns& unknowns,
                              const std::unordered_map<std::uint64_t, Vector>& by_turn,
                              std::vector<double>& values) const {
  dispatch(system.grid, [&]<ShapeKind kind, bool>() {
    for_stencils<kind>(system, [&](std::size_t n, std::size_t i, const auto& stencil) {
      const auto slope = by_turn.find(key_of(n, i));
      if (slope == by_turn.end()) return;
      for (const StencilNode& from : stencil) {
        if (from.node < 0) continue;
        const auto node_b = static_cast<std::size_t>(from.node);
        for (std::size_t cb = 0; cb < 2; ++cb) {
          const std::int32_t column = unknowns.number[2 * node_b + cb];
          if (column < 0) continue;
          const double turn = from.parity[cb] * (cb == 0 ? -0.5 * from.slope_z : 0.5 * from.slope_r);
          const std::int64_t start = pattern_.column[static_cast<std::size_t>(column)];
          for (const StencilNode& to : stencil) {
            if (to.node < 0) continue;
            std::int64_t place = start + links_[node_b].first_row[offset_between(from, to)];
            for (std::size_t ca = 0; ca < 2; ++ca)
              if (unknowns.number[2 * static_cast<std::size_t>(to.node) + ca] >= 0)
                values[static_cast<std::size_t>(place++)] -=
                    to.parity[ca] * to.value * slope->second[ca] * turn;
          }
        }
      }
    });
  });
}

void Stiffness::lay_out(const System& system, const NodalUnknowns& unknowns,
                        std::span<const CarrierPair> couplings) {
  const Grid& grid = system.grid;
  list_shares(system, unknowns, couplings);
  const std::vector<std::vector<std::int64_t>> coupled = coupled_rows(unknowns.size(), couplings);
  links_.assign(grid.blocks().size() * block_nodes, {});
  dispatch(grid, [&]<ShapeKind kind, bool>() {
    for_stencils<kind>(system, [&](std::size_t, std::size_t, const auto& stencil) {
      for (const StencilNode& from : stencil)
        for (const StencilNode& to : stencil)
          if (from.node >= 0 && to.node >= 0)
            links_[static_cast<std::size_t>(from.node)].mask |= std::uint64_t{1} << offset_between(from, to);
    });
  });
  pattern_.column.assign(1, 0);
  pattern_.row.clear();
  diagonal_.clear();
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const std::size_t node = unknowns.node[k];
    const Block& block = grid.blocks()[node / block_nodes];
    const int i = static_cast<int>(node % block_nodes) % block_side,
              j = static_cast<int>(node % block_nodes) / block_side;
    Links& links = links_[node];
    std::uint8_t rows = 0;
    for (int o = 0; o < neighbour_offsets; ++o) {
      links.first_row[static_cast<std::size_t>(o)] = rows;
      if ((links.mask >> o & 1U) == 0) continue;
      const std::int64_t other = node_at(block, i + o % neighbour_width - neighbour_reach,
                                         j + o / neighbour_width - neighbour_reach);
      for (std::size_t c = 0; c < 2; ++c) {
        const std::int32_t row = unknowns.number[2 * static_cast<std::size_t>(other) + c];
        if (row < 0) continue;
        if (row == static_cast<std::int32_t>(k))
          diagonal_.push_back(static_cast<std::int64_t>(pattern_.row.size()));
        pattern_.row.push_back(row);
        ++rows;
      }
    }
    if (!coupled.empty()) pattern_.row.insert(pattern_.row.end(), coupled[k].begin(), coupled[k].end());
    pattern_.column.push_back(static_cast<std::int64_t>(pattern_.row.size()));
  }
}

void Stiffness::assemble(const System& system, const NodalUnknowns& unknowns,
                         std::span<const ParticleGradient> gradients,
                         std::span<const std::vector<TangentEntries>> tangents,
                         std::vector<double>& values) const {
  const Grid& grid = system.grid;
  values.assign(pattern_.row.size(), 0.0);
  dispatch(grid, [&]<ShapeKind kind, bool axisymmetric>() {
    for_stencils<kind>(system, [&](std::size_t n, std::size_t i, const auto& stencil) {
      const Particles& p = system.bodies[n].particles;
      const auto& g = gradients[n].gradient;
      const FiniteStrain deformation({g[0][i], g[1][i], g[2][i], g[3][i], g[4][i]});
      const double volume = p.mass[i] / system.bodies[n].material->density();
      const TangentEntries& T = tangents[n][i];
      const double hoop = axisymmetric ? 1.0 / hoop_radius(p.position[0][i], grid.cell()) : 0.0;
      std::optional<BetweenCentroids> H;
      if (const auto& h = p.centroids; !h[0].empty())
        H.emplace(BetweenCentroids::Matrix{h[0][i], h[1][i], h[2][i], h[3][i]});
      // Columns of B: the strain that a unit displacement of a component makes; and of V T B, both shears
      // counted.
      constexpr std::size_t count = std::tuple_size_v<std::remove_cvref_t<decltype(stencil)>>;
      std::array<std::array<double, 4>, 2 * count> B{}, TB{};
      for (std::size_t a = 0; a < count; ++a) {
        const StencilNode& s = stencil[a];
        const auto change = [&](const std::array<double, 4>& plain, double tt) {
          const auto [rr, rz, zr, zz] = H ? H->gradient(plain) : plain;
          return deformation.change({rr, rz, zr, zz, tt});
        };
        const SymmetricTensor r = change({s.slope_r, s.slope_z, 0.0, 0.0}, s.value * hoop),
                              z = change({0.0, 0.0, s.slope_r, s.slope_z}, 0.0);
        const auto [across_r, across_z] = s.parity;
        B[2 * a] = {across_r * r.rr, across_r * r.zz, across_r * r.tt, across_r * r.rz};
        B[2 * a + 1] = {across_z * z.rr, across_z * z.zz, across_z * z.tt, across_z * z.rz};
      }
      for (std::size_t a = 0; a < 2 * count; ++a)
        for (std::size_t row = 0; row < 4; ++row) {
          const double* t = T.data() + 4 * row;
          TB[a][row] = (row == 3 ? 2.0 : 1.0) * volume *
                       (t[0] * B[a][0] + t[1] * B[a][1] + t[2] * B[a][2] + t[3] * B[a][3]);
        }
      for (std::size_t b = 0; b < count; ++b) {
        if (stencil[b].node < 0) continue;
        const auto node_b = static_cast<std::size_t>(stencil[b].node);
        for (std::size_t cb = 0; cb < 2; ++cb) {
          const std::int32_t column = unknowns.number[2 * node_b + cb];
          if (column < 0) continue;
          const std::int64_t start = pattern_.column[static_cast<std::size_t>(column)];
          for (std::size_t a = 0; a < count; ++a) {
            if (stencil[a].node < 0) continue;
            const auto node_a = static_cast<std::size_t>(stencil[a].node);
            std::int64_t place = start + links_[node_b].first_row[offset_between(stencil[b], stencil[a])];
            for (std::size_t ca = 0; ca < 2; ++ca) {
              if (unknowns.number[2 * node_a + ca] < 0) continue;
              const auto& left = B[2 * a + ca];
              const auto& right = TB[2 * b + cb];
              values[static_cast<std::size_t>(place++)] +=
                  left[0] * right[0] + left[1] * right[1] + left[2] * right[2] + left[3] * right[3];
            }
          }
        }
      }
    });
  });
}

}  // namespace vitrum::mpm
