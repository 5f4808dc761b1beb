#include "observe/fragments.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "mpm/near.hpp"

namespace vitrum {
namespace {

/// Union-find with path halving.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a), b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

constexpr double reach_in_cells = 1.5;

}  // namespace

std::vector<ConnectedPiece> pieces_of(const System& system, std::size_t body_index) {
  const Particles& p = system.bodies[body_index].particles;
  const std::vector<double>& decohesion = system.bodies[body_index].column("decohesion");
  const double reach = reach_in_cells * system.cell;
  std::vector<std::uint32_t> whole;
  for (std::uint32_t i = 0; i < p.size; ++i)
    if (decohesion[i] < 1.0) whole.push_back(i);
  DisjointSets sets(p.size);
  mpm::find_near(whole, p.position, reach, [&](std::uint32_t i, std::uint32_t j) { sets.join(i, j); });
  std::unordered_map<std::size_t, std::size_t> piece_of_root;
  std::vector<ConnectedPiece> pieces;
  for (std::size_t i = 0; i < p.size; ++i) {
    if (!(decohesion[i] < 1.0)) continue;
    const auto [entry, added] = piece_of_root.try_emplace(sets.root(i), pieces.size());
    if (added) pieces.push_back({body_index, {}});
    pieces[entry->second].particles.push_back(i);
  }
  return pieces;
}

bool separates(const Body& body) {
  return body.material->column("decohesion").has_value();
}

std::vector<ConnectedPiece> connected_pieces(const System& system) {
  std::vector<ConnectedPiece> all;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    if (!separates(system.bodies[n])) continue;
    for (ConnectedPiece& piece : pieces_of(system, n)) all.push_back(std::move(piece));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.particles.size() > b.particles.size(); });
  return all;
}

std::vector<std::vector<double>> piece_numbers(const System& system) {
  if (std::none_of(system.bodies.begin(), system.bodies.end(), separates)) return {};
  constexpr double separated = -1.0, not_modelled = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::vector<double>> numbers;
  for (const Body& body : system.bodies)
    numbers.emplace_back(body.particles.size, separates(body) ? separated : not_modelled);
  double number = 0.0;
  for (const ConnectedPiece& piece : connected_pieces(system)) {
    for (const std::size_t particle : piece.particles) numbers[piece.body][particle] = number;
    number += 1.0;
  }
  return numbers;
}

std::vector<Fragment> fragments(const System& system, const std::vector<ConnectedPiece>& pieces) {
  const double whole = system.axisymmetric ? 2.0 * std::numbers::pi : 1.0;
  std::vector<Fragment> result;
  for (const ConnectedPiece& piece : pieces) {
    const Particles& p = system.bodies[piece.body].particles;
    Fragment f{system.bodies[piece.body].name, piece.particles.size(), 0.0, {0.0, 0.0}, {0.0, 0.0}};
    for (const std::size_t i : piece.particles) {
      f.mass += p.mass[i];
      for (std::size_t k = 0; k < 2; ++k) {
        f.centre[k] += p.mass[i] * p.position[k][i];
        f.velocity[k] += p.mass[i] * p.velocity[k][i];
      }
    }
    for (std::size_t k = 0; k < 2; ++k) f.centre[k] /= f.mass, f.velocity[k] /= f.mass;
    f.mass *= whole;
    result.push_back(f);
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Fragment& a, const Fragment& b) { return a.mass > b.mass; });
  return result;
}

}  // namespace vitrum
