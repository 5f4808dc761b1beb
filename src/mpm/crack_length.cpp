#include "mpm/crack_length.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mpm/near.hpp"

namespace vitrum::mpm {
namespace {

/// A square of a cell's side. As in mpm/near.hpp, coordinates are whole, but doubles.
using Square = std::array<double, 2>;
Square square_of(const Particles& p, std::size_t i, double cell) {
  return {std::floor(p.position[0][i] / cell), std::floor(p.position[1][i] / cell)};
}

/// The squares no further than two from those of the particles.
std::vector<Square> squares_around(const Particles& p, std::span<const std::size_t> particles, double cell) {
  std::vector<Square> squares;
  for (const std::size_t i : particles)
    for (const double a : {-2.0, -1.0, 0.0, 1.0, 2.0})
      for (const double b : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
        const Square at = square_of(p, i, cell);
        squares.push_back({at[0] + a, at[1] + b});
      }
  std::sort(squares.begin(), squares.end());
  squares.erase(std::unique(squares.begin(), squares.end()), squares.end());
  return squares;
}

/// Cracked particles of a body by identity, so that sums do not depend on how particles are stored.
struct Cracked {
  std::vector<std::size_t> particle;
  VectorColumns position, normal;
  std::vector<bool> affected;  ///< localised just now, or in reach of one that has
  std::vector<double> rows;    ///< that the crack has taken
};

class CrackColumns {
 public:
  explicit CrackColumns(Body& body)
      : length_(column(body, "effective_length")),
        opening_n_(column(body, "opening_n")),
        opening_t_(column(body, "opening_t")),
        normal_r_(column(body, "normal_r")),
        normal_z_(column(body, "normal_z")) {}

  bool crosses_cell(std::size_t i) const {
    return length_[i] > 0.0 && (normal_r_[i] != 0.0 || normal_z_[i] != 0.0);
  }
  double normal(std::size_t c, std::size_t i) const { return c == 0 ? normal_r_[i] : normal_z_[i]; }
  void set_length(std::size_t i, double length) {
    const double ratio = length / length_[i];
    length_[i] = length, opening_n_[i] *= ratio, opening_t_[i] *= ratio;
  }

 private:
  static std::vector<double>& column(Body& body, std::string_view name) {
    return body.particles.variables[body.material->column(name).value()];
  }
  std::vector<double>&length_, &opening_n_, &opening_t_, &normal_r_, &normal_z_;
};

Cracked cracked_near(const Body& body, const CrackColumns& columns, std::vector<std::size_t> localised,
                     double cell) {
  const Particles& p = body.particles;
  const std::vector<Square> squares = squares_around(p, localised, cell);
  Cracked cracked;
  for (std::size_t i = 0; i < p.size; ++i)
    if (columns.crosses_cell(i) && std::binary_search(squares.begin(), squares.end(), square_of(p, i, cell)))
      cracked.particle.push_back(i);
  std::ranges::sort(cracked.particle, {}, [&](std::size_t i) { return p.identity[i]; });
  std::ranges::sort(localised);
  for (const std::size_t i : cracked.particle) {
    for (std::size_t c = 0; c < 2; ++c)
      cracked.position[c].push_back(p.position[c][i]), cracked.normal[c].push_back(columns.normal(c, i));
    cracked.affected.push_back(std::ranges::binary_search(localised, i));
  }
  cracked.rows.assign(cracked.particle.size(), 1.0);
  return cracked;
}

void share(Body& body, const std::vector<std::size_t>& localised, double cell, double per_side) {
  CrackColumns columns(body);
  Cracked cracked = cracked_near(body, columns, localised, cell);
  const std::vector<bool> localised_now = cracked.affected;
  const double side = cell / per_side;
  const auto way = [&](std::size_t i) {
    return std::max(std::abs(cracked.normal[0][i]), std::abs(cracked.normal[1][i]));
  };
  const auto add = [&](std::size_t i, std::size_t j) {
    const double n0 = cracked.normal[0][i], n1 = cracked.normal[1][i],
                 x0 = cracked.position[0][j] - cracked.position[0][i],
                 x1 = cracked.position[1][j] - cracked.position[1][i],
                 cosine = n0 * cracked.normal[0][j] + n1 * cracked.normal[1][j];
    const double overlap = 1.0 - std::abs(n0 * x1 - n1 * x0) / (side * (std::abs(n0) + std::abs(n1)));
    if (overlap <= 0.0 || std::abs(n0 * x0 + n1 * x1) >= (per_side - 0.5) * side * way(i)) return;
    cracked.rows[i] += overlap * cosine * cosine;
    if (localised_now[j]) cracked.affected[i] = true;
  };
  std::vector<std::uint32_t> all(cracked.particle.size());
  std::iota(all.begin(), all.end(), 0U);
  // Along the plane and across it no more than 1.5 cells in all.
  find_near(all, cracked.position, 1.5 * cell,
            [&](std::uint32_t i, std::uint32_t j) { add(i, j), add(j, i); });
  for (std::size_t k = 0; k < all.size(); ++k)
    if (cracked.affected[k])
      columns.set_length(cracked.particle[k], side * way(k) * std::min(per_side, cracked.rows[k]));
}

}  // namespace

void share_cracks(System& system) {
  std::vector<std::size_t> localised;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    Body& body = system.bodies[n];
    const double per_side = std::round(system.cell / (2.0 * body.particle_half_size));
    if (per_side < 2.0) continue;
    localised.clear();
    for (const BodyEvent& e : system.record.events)
      if (e.body == n && e.event.kind == EventKind::localisation) localised.push_back(e.particle);
    if (!localised.empty()) share(body, localised, system.cell, per_side);
  }
}

}  // namespace vitrum::mpm
