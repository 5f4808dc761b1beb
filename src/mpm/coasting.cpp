#include "mpm/coasting.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/blocks.hpp"
#include "mpm/loads.hpp"
#include "mpm/tractions.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {
namespace {

/// Cells [first, last] along both directions.
struct CellBox {
  std::array<double, 2> first, last;
};

bool overlap(const CellBox& a, const CellBox& b) {
  return a.first[0] <= b.last[0] && b.first[0] <= a.last[0] && a.first[1] <= b.last[1] &&
         b.first[1] <= a.last[1];
}

CellBox cells_of(const Coasting& body, double cell) {
  CellBox box{};
  for (std::size_t k = 0; k < 2; ++k)
    box.first[k] = std::floor(body.lowest[k] / cell), box.last[k] = std::floor(body.highest[k] / cell);
  return box;
}

/// Cells in which another particle may share a node with one of the box. A particle of cell i touches nodes i
/// and i + 1 (linear), or no others than i - 1 to i + 2.
CellBox neighbourhood(CellBox box, ShapeKind shape) {
  const double reach = shape == ShapeKind::linear ? 1.0 : 3.0;
  for (std::size_t k = 0; k < 2; ++k) box.first[k] -= reach, box.last[k] += reach;
  return box;
}

bool are_uniform(const std::vector<double>& values, double value) {
  return std::all_of(values.begin(), values.end(), [=](double v) { return v == value; });
}

bool may_coast(const System& system, const Body& body) {
  const Particles& p = body.particles;
  constexpr double farthest = 2.0e9;  // cells: the grid refuses what is further off, and what is no number
  for (const std::vector<double>& x : p.position)
    if (!std::all_of(x.begin(), x.end(), [&](double v) { return std::abs(v) < farthest * system.cell; }))
      return false;
  if (p.size == 0 || has_gravity(system)) return false;
  if (system.tractions && system.tractions->act_on(static_cast<std::size_t>(&body - system.bodies.data())))
    return false;
  for (std::size_t k = 0; k < 2; ++k)
    if (!std::isfinite(p.velocity[k][0]) || !are_uniform(p.velocity[k], p.velocity[k][0])) return false;
  if (system.axisymmetric && p.velocity[0][0] != 0.0) return false;  // hoops would stretch
  return std::all_of(p.elastic_strain.begin(), p.elastic_strain.end(),
                     [](const std::vector<double>& e) { return are_uniform(e, 0.0); });
}

void find_bounds(const Particles& p, Coasting& c) {
  for (std::size_t k = 0; k < 2; ++k) {
    const auto [least, greatest] = std::minmax_element(p.position[k].begin(), p.position[k].end());
    c.lowest[k] = *least, c.highest[k] = *greatest;
  }
}

void start(Body& body) {
  const Particles& p = body.particles;
  Coasting c{{p.velocity[0][0], p.velocity[1][0]}, {}, {}, 0.0};
  find_bounds(p, c);
  for (const double m : p.mass)
    c.kinetic += 0.5 * m * (c.velocity[0] * c.velocity[0] + c.velocity[1] * c.velocity[1]);
  body.coasting = c;
}

/// Whether a held node that the body may touch asks for another velocity than the body's.
bool meets_boundary(const System& system, const Coasting& body) {
  const double cell = system.cell, reach = system.grid.shape() == ShapeKind::linear ? 1.0 : 2.0;
  for (std::size_t n = 0; n < system.grid.boundaries().size(); ++n) {
    const Boundary& wall = system.grid.boundaries()[n];
    bool differs = false, near = true;
    for (std::size_t k = 0; k < 2; ++k) {
      const double gone = system.grid.shift(n, k) * cell;
      differs = differs || (wall.fixed[k] && (wall.drive[k] || wall.velocity[k] != body.velocity[k]));
      near = near && wall.min[k] + gone <= body.highest[k] + reach * cell &&
             wall.max[k] + gone >= body.lowest[k] - reach * cell;
    }
    if (differs && near) return true;
  }
  return false;
}

CellBox box_of(const Block& b) {
  const auto at = [&](std::size_t k) { return static_cast<double>(b.cells[k]); };
  return {{at(0), at(2)}, {at(1), at(3)}};
}

/// A block with the cells that it would have if the lists were made anew: those of a block grow with its
/// history, which must not decide when a body wakes.
Block as_made_anew(const System& system, const Block& b) {
  std::optional<Block> made;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const auto [begin, end] = system.grid.particles(static_cast<std::size_t>(b.tile), n);
    const Particles& p = system.bodies[n].particles;
    for (const std::uint32_t* at = begin; at != end; ++at) {
      const std::int64_t i = cell_of(p.position[0][*at] * (1.0 / system.cell)),
                         j = cell_of(p.position[1][*at] * (1.0 / system.cell));
      if (!made) made = block_at(i, j, b.field);
      widen(*made, i, j);
    }
  }
  return made.value_or(b);
}

bool meets_another(const System& system, const Body& body) {
  const double cell = system.cell;
  const CellBox reach = neighbourhood(cells_of(*body.coasting, cell), system.grid.shape());
  for (const Body& other : system.bodies)
    if (&other != &body && other.coasting && other.coasting->velocity != body.coasting->velocity &&
        overlap(reach, cells_of(*other.coasting, cell)))
      return true;
  return std::any_of(system.grid.blocks().begin(), system.grid.blocks().end(), [&](const Block& b) {
    return b.tile >= 0 && overlap(reach, box_of(b)) && overlap(reach, box_of(as_made_anew(system, b)));
  });
}

}  // namespace

void find_coasting(System& system) {
  if (system.coasting_settled) return;
  system.coasting_settled = true;
  for (Body& body : system.bodies)
    if (may_coast(system, body)) start(body);
  system.grid_is_stale = true;
}

void restore_coasting(System& system, const std::vector<double>& coasting) {
  system.coasting_settled = true;
  for (std::size_t n = 0; n < system.bodies.size(); ++n)
    if (coasting[n] != 0.0 && system.bodies[n].particles.size > 0) start(system.bodies[n]);
  system.grid_is_stale = true;
}

void refresh_grid_and_wake(System& system) {
  // Who wakes may wake others.
  for (bool woken = true; woken;) {
    refresh_grid(system, Storage::sorted);
    std::vector<Body*> near;
    for (Body& body : system.bodies)
      if (body.coasting && (meets_boundary(system, *body.coasting) || meets_another(system, body)))
        near.push_back(&body);
    for (Body* body : near) body->coasting.reset();
    woken = !near.empty();
    system.grid_is_stale = system.grid_is_stale || woken;
  }
}

void coast(System& system, double duration) {
  for (Body& body : system.bodies) {
    if (!body.coasting) continue;
    Coasting& c = *body.coasting;
    for (std::size_t k = 0; k < 2; ++k) {
      const double travel = duration * c.velocity[k];
      if (travel == 0.0) continue;
      for (double& x : body.particles.position[k]) x += travel;
    }
    // (Rounding keeps the order of positions: the extremes move like all others.)
    for (std::size_t k = 0; k < 2; ++k)
      c.lowest[k] += duration * c.velocity[k], c.highest[k] += duration * c.velocity[k];
    system.record.kinetic += c.kinetic;
  }
}

}  // namespace vitrum::mpm
