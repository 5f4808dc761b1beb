#include "mpm/contact/fragments.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "mpm/near.hpp"

namespace vitrum::mpm {
namespace {

constexpr double joint_in_sides = 1.5;        // the eight neighbours of a particle in a lattice
constexpr std::size_t inside = 8;             // neighbours of a particle that is at no surface
constexpr std::size_t smallest_fragment = 4;  // particles: less is rubble, which goes with what it lies at
constexpr std::int32_t none = -1, rubble = -2;

/// Whether particles are cut off from their neighbours, by identity: separated, and the crack is open, or
/// they have left the computation.
std::vector<bool> cut_particles(const Body& body) {
  const std::vector<double>&decohesion = body.column("decohesion"), &opening = body.column("opening_n");
  std::vector<bool> cut(body.particles.size, false);
  for (std::size_t i = 0; i < cut.size(); ++i)
    if (decohesion[i] >= 1.0 && (opening[i] > 0.0 || i >= body.present()))
      cut[body.particles.identity[i]] = true;
  return cut;
}

}  // namespace

Fragments::Fragments(const Body& body)
    : first_(body.particles.size + 1, 0), cut_(body.particles.size, false) {
  if (body.column("decohesion").empty()) return;
  const Particles& p = body.particles;
  const double reach = joint_in_sides * 2.0 * body.particle_half_size;
  std::vector<std::uint32_t> all(p.size);
  std::iota(all.begin(), all.end(), 0U);
  std::vector<std::vector<std::uint32_t>> near(p.size);
  find_near(all, p.position, reach,
            [&](std::uint32_t i, std::uint32_t j) { near[i].push_back(j), near[j].push_back(i); });
  for (std::size_t i = 0; i < p.size; ++i) {
    std::sort(near[i].begin(), near[i].end());
    neighbours_.insert(neighbours_.end(), near[i].begin(), near[i].end());
    first_[i + 1] = static_cast<std::uint32_t>(neighbours_.size());
  }
}

std::vector<std::uint32_t> Fragments::cut() const {
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < cut_.size(); ++i)
    if (cut_[i]) list.push_back(i);
  return list;
}

bool Fragments::part(Body& body, std::int32_t& next_field) {
  if (neighbours_.empty()) return false;
  const std::vector<bool> cut = cut_particles(body);
  bool more = false;
  for (std::size_t i = 0; i < cut.size() && !more; ++i) more = cut[i] && !cut_[i];
  cut_ = cut;
  if (!more) return false;  // what closes parts nothing
  const std::size_t size = cut.size();
  std::vector<std::int32_t> former = body.fragments;
  if (former.empty()) former.assign(size, body.field);

  // Pieces: what is connected by joints between particles that nothing cuts, within a former fragment.
  std::vector<std::int32_t> piece(size, none);
  std::vector<std::uint32_t> queue;
  const auto spread = [&](std::size_t from, const auto& may_enter) {
    for (std::size_t k = from; k < queue.size(); ++k)
      for (std::uint32_t n = first_[queue[k]]; n < first_[queue[k] + 1]; ++n) {
        const std::uint32_t next = neighbours_[n];
        if (piece[next] != none || former[next] != former[queue[k]] || !may_enter(next)) continue;
        piece[next] = piece[queue[k]], queue.push_back(next);
      }
  };
  struct Piece {
    std::int32_t field;
    std::size_t particles;
  };
  std::vector<Piece> pieces;
  for (std::uint32_t i = 0; i < size; ++i) {
    if (cut[i] || piece[i] != none) continue;
    const std::size_t from = queue.size();
    piece[i] = static_cast<std::int32_t>(pieces.size()), queue.push_back(i);
    spread(from, [&](std::uint32_t next) { return !cut[next]; });
    if (queue.size() - from >= smallest_fragment) {
      pieces.push_back({former[i], queue.size() - from});
    } else {  // not looked at again
      for (std::size_t k = from; k < queue.size(); ++k) piece[queue[k]] = rubble;
      queue.resize(from);
    }
  }
  std::ranges::replace(piece, rubble, none);
  // Rubble and particles in cracks: the nearest piece's.
  spread(0, [](std::uint32_t) { return true; });

  // The largest piece of each former fragment keeps its field.
  std::vector<std::size_t> order(pieces.size());
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t n) { return pieces[n].particles; });
  std::vector<std::int32_t> kept, field(pieces.size());
  for (const std::size_t n : order)
    if (std::ranges::find(kept, pieces[n].field) == kept.end())
      kept.push_back(field[n] = pieces[n].field);
    else
      field[n] = next_field++;
  if (kept.size() == pieces.size()) return false;
  body.fragments = std::move(former);
  for (std::size_t i = 0; i < size; ++i)
    if (piece[i] != none) body.fragments[i] = field[static_cast<std::size_t>(piece[i])];
  find_faces(body);
  return true;
}

void Fragments::restored(const Body& body, std::span<const std::uint32_t> cut) {
  cut_.assign(body.particles.size, false);
  for (const std::uint32_t i : cut) cut_[i] = true;
  faces_.clear();
  if (!body.fragments.empty()) find_faces(body);
}

void Fragments::find_faces(const Body& body) {
  faces_.clear();
  for (std::uint32_t i = 0; i < body.particles.size; ++i) {
    std::size_t own = 0;
    for (std::uint32_t n = first_[i]; n < first_[i + 1]; ++n)
      if (body.fragments[neighbours_[n]] == body.fragments[i]) ++own;
    if (own < inside) faces_.push_back(i);
  }
}

}  // namespace vitrum::mpm
