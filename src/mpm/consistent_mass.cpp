#include "mpm/consistent_mass.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mpm/stencil_nodes.hpp"

namespace vitrum::mpm {
namespace {

constexpr std::size_t rows_of_a_chunk = 512;

/// The share of a particle's mass that is lumped: its place matters to its forces as far as it is pressed.
double lumped_share(const Particles& p, std::size_t i) {
  const double pressed = largest_principal(-1.0 * tensor_at(p.elastic_strain, i));
  constexpr double from = ConsistentMass::lumped_from, width = ConsistentMass::lumped_at - from;
  return std::clamp((pressed - from) / width, 0.0, 1.0);
}

}  // namespace

/// A particle's shares of what held nodes and boundaries weigh.
template <class Stencil>
void ConsistentMass::add_held(const NodalUnknowns& unknowns, const Grid& grid, const Stencil& stencil,
                              double mass, const std::array<double, 2>& velocity) {
  for (const StencilNode& a : stencil)
    for (std::size_t c = 0; c < 2 && a.node >= 0; ++c) {
      const std::int16_t by = grid.constraint(c, static_cast<std::size_t>(a.node));
      if (by < 0) continue;
      Held& held = held_[static_cast<std::size_t>(by)];
      const double share = a.parity[c] * a.value * mass;
      held.momentum[c] += share * velocity[c];
      for (const StencilNode& b : stencil) {
        if (b.node < 0) continue;
        const auto node = static_cast<std::size_t>(b.node);
        const std::int32_t unknown = unknowns.number[2 * node + c];
        const std::int16_t other = grid.constraint(c, node);
        if (unknown >= 0) held.unknowns[static_cast<std::size_t>(unknown)] += share * b.parity[c] * b.value;
        if (other >= 0) held.mass[c][static_cast<std::size_t>(other)] += share * b.parity[c] * b.value;
      }
    }
}

void ConsistentMass::assemble(const System& system, const NodalUnknowns& unknowns) {
  const Grid& grid = system.grid;
  const std::size_t n = unknowns.size(), walls = grid.boundaries().size();
  std::vector<Neighbour> table(n * neighbour_offsets, Neighbour{-1, 0.0});
  held_.clear();
  if (drives(system)) {
    held_.resize(walls);
    for (Held& held : held_)
      held.mass = {std::vector(walls, 0.0), std::vector(walls, 0.0)}, held.unknowns.assign(n, 0.0);
  }
  dispatch(grid, [&]<ShapeKind kind, bool>() {
    for_stencils<kind>(system, [&](std::size_t body, std::size_t i, const auto& stencil) {
      const Particles& p = system.bodies[body].particles;
      const double lumped = lumped_share(p, i), carried = 1.0 - lumped;
      for (const StencilNode& a : stencil)
        for (std::size_t c = 0; c < 2 && a.node >= 0; ++c) {
          const std::int32_t row = unknowns.number[2 * static_cast<std::size_t>(a.node) + c];
          if (row < 0) continue;
          const auto add = [&](std::size_t offset, std::int32_t column, double mass) {
            Neighbour& entry = table[static_cast<std::size_t>(row) * neighbour_offsets + offset];
            entry.unknown = column, entry.mass += mass;
          };
          const double share = a.parity[c] * a.value * p.mass[i];
          if (lumped > 0.0) add(offset_between(a, a), row, lumped * a.value * p.mass[i]);
          for (const StencilNode& b : stencil) {
            const std::int32_t column =
                b.node < 0 ? -1 : unknowns.number[2 * static_cast<std::size_t>(b.node) + c];
            if (column >= 0) add(offset_between(a, b), column, carried * share * b.parity[c] * b.value);
          }
        }
      if (!held_.empty()) add_held(unknowns, grid, stencil, p.mass[i], {p.velocity[0][i], p.velocity[1][i]});
    });
  });
  start_.assign(1, 0), neighbours_.clear();
  for (std::size_t k = 0; k < n; ++k) {
    std::copy_if(table.begin() + static_cast<std::ptrdiff_t>(k * neighbour_offsets),
                 table.begin() + static_cast<std::ptrdiff_t>((k + 1) * neighbour_offsets),
                 std::back_inserter(neighbours_), [](const Neighbour& entry) { return entry.unknown >= 0; });
    start_.push_back(neighbours_.size());
  }
  per_mass_.resize(n);
  std::ranges::transform(unknowns.mass, per_mass_.begin(), [](double mass) { return 1.0 / mass; });
  component_ = unknowns.component;
}

void ConsistentMass::project(const System& system, const double* q, double* changes) const {
  const std::size_t n = per_mass_.size();
  system.team->for_each_chunk((n + rows_of_a_chunk - 1) / rows_of_a_chunk, [&](std::size_t chunk) {
    for (std::size_t k = chunk * rows_of_a_chunk; k < std::min(n, (chunk + 1) * rows_of_a_chunk); ++k)
      changes[k] = times_row(k, q) * per_mass_[k];
  });
}

double ConsistentMass::gain(const double* q, const double* v) const {
  double gained = 0.0;
  for (std::size_t k = 0; k < per_mass_.size(); ++k)
    gained += q[k] * (v[k] / per_mass_[k] + 0.5 * times_row(k, q));
  return gained;
}

double ConsistentMass::gain_by_boundaries(const double* q,
                                          std::span<const std::array<double, 2>> changes) const {
  double gained = 0.0;
  for (std::size_t b = 0; b < held_.size(); ++b)
    for (std::size_t c = 0; c < 2; ++c) {
      if (changes[b][c] == 0.0) continue;
      double momentum = held_[b].momentum[c];
      for (std::size_t k = 0; k < component_.size(); ++k)
        if (component_[k] == c) momentum += held_[b].unknowns[k] * q[k];
      for (std::size_t other = 0; other < held_.size(); ++other)
        momentum += 0.5 * held_[b].mass[c][other] * changes[other][c];
      gained += changes[b][c] * momentum;
    }
  return gained;
}

sundials::SparsePattern ConsistentMass::times(const sundials::SparsePattern& pattern) const {
  sundials::SparsePattern product;
  product.column.assign(1, 0);
  std::vector<std::int64_t> last_column(pattern.size(), -1);
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    for (auto e = static_cast<std::size_t>(pattern.column[k]);
         e < static_cast<std::size_t>(pattern.column[k + 1]); ++e)
      for (const Neighbour& at : row(static_cast<std::size_t>(pattern.row[e]))) {
        std::int64_t& last = last_column[static_cast<std::size_t>(at.unknown)];
        if (last == static_cast<std::int64_t>(k)) continue;
        last = static_cast<std::int64_t>(k);
        product.row.push_back(at.unknown);
      }
    product.column.push_back(static_cast<std::int64_t>(product.row.size()));
  }
  return product;
}

void ConsistentMass::times(const sundials::SparsePattern& pattern, const std::vector<double>& values,
                           const sundials::SparsePattern& product, std::vector<double>& result) const {
  result.resize(product.row.size());
  std::vector<double> sum(pattern.size(), 0.0);
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    for (auto e = static_cast<std::size_t>(pattern.column[k]);
         e < static_cast<std::size_t>(pattern.column[k + 1]); ++e) {
      const auto unknown = static_cast<std::size_t>(pattern.row[e]);
      const double factor = values[e] * per_mass_[unknown];
      for (const Neighbour& at : row(unknown)) sum[static_cast<std::size_t>(at.unknown)] += factor * at.mass;
    }
    for (auto e = static_cast<std::size_t>(product.column[k]);
         e < static_cast<std::size_t>(product.column[k + 1]); ++e)
      result[e] = std::exchange(sum[static_cast<std::size_t>(product.row[e])], 0.0);
  }
}

}  // namespace vitrum::mpm
