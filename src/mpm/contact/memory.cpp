#include "mpm/contact/contact.hpp"

// What contact must remember to go on from a checkpoint.

namespace vitrum::mpm {

std::vector<double> Contact::state(const System& system) const {
  std::vector<double> values;
  const auto put = [&](const auto&... number) { (values.push_back(static_cast<double>(number)), ...); };
  for (const ContactHistory& h : history_) put(h.impulse[0], h.impulse[1], h.friction_work, h.least_gap);
  put(next_field_);
  for (std::size_t body = 0; body < fragments_.size(); ++body) {
    const std::vector<std::int32_t>& fragment = system.bodies[body].fragments;
    const std::vector<std::uint32_t> cut = fragments_[body].cut();
    put(cut.size(), fragment.size());
    values.insert(values.end(), cut.begin(), cut.end());
    values.insert(values.end(), fragment.begin(), fragment.end());
  }
  put(rests_.size());
  for (const Rest& rest : rests_) put(rest.body, rest.i, rest.j, rest.distance);
  put(grips_.size());
  for (const Grip& g : grips_)
    put(g.key.pair, g.key.patch_a, g.key.patch_b, g.key.carrier_a, g.key.carrier_b, g.spring.force,
        g.spring.stiffness);
  return values;
}

bool Contact::restore(System& system, std::span<const double> state) {
  bool fits = true;
  const auto take = [&] {
    fits = fits && !state.empty();
    if (!fits) return 0.0;
    const double value = state.front();
    state = state.subspan(1);
    return value;
  };
  // A count or an index below a bound.
  const auto below = [&](std::size_t bound) -> std::uint32_t {
    const double value = take();
    fits = fits && value >= 0.0 && value < static_cast<double>(bound);
    return fits ? static_cast<std::uint32_t>(value) : 0;
  };
  for (ContactHistory& h : history_) h = {{take(), take()}, take(), take()};
  constexpr std::size_t any = TouchKey::none;
  next_field_ = static_cast<std::int32_t>(below(any / 2));
  for (std::size_t body = 0; body < fragments_.size(); ++body) {
    std::vector<std::uint32_t> cut(below(state.size() + 1));
    const std::size_t size = below(state.size() + 1), particles = system.bodies[body].particles.size;
    for (std::uint32_t& identity : cut) identity = below(particles);
    std::vector<std::int32_t>& fragment = system.bodies[body].fragments;
    fits = fits && (size == 0 || size == particles);
    fragment.assign(fits ? size : 0, 0);
    for (std::int32_t& field : fragment) field = static_cast<std::int32_t>(below(any / 2));
    fragments_[body].restored(system.bodies[body], cut);
  }
  rests_.resize(below(state.size() + 1));
  for (Rest& rest : rests_) {
    const std::uint32_t body = below(place_.size());
    const std::size_t particles = place_[body].size();
    rest = {body, below(particles), below(particles), take()};
  }
  grips_.resize(below(state.size() + 1));
  for (Grip& grip : grips_) {
    const std::uint32_t pair = below(pairs_.size()), patch_a = below(std::size_t{any} + 1),
                        patch_b = below(std::size_t{any} + 1),
                        a = fits ? below(place_[pairs_[pair].a].size()) : 0,
                        b = fits ? below(place_[pairs_[pair].b].size()) : 0;
    const double force = take(), stiffness = take();
    grip = {{pair, patch_a, patch_b, a, b}, {force, stiffness}, {}, 0.0, 0.0, 0.0, 0.0};
  }
  if (!fits || !state.empty()) return false;
  system.grid_is_stale = true;
  found_ = false;
  settle(system);
  evaluated_ = true;
  return true;
}

}  // namespace vitrum::mpm
