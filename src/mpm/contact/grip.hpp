#pragma once
#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>

#include "mpm/contact/patch.hpp"

namespace vitrum::mpm {

/// What touches: two patches, or two particles that no patch stands for.
struct TouchKey {
  static constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);
  std::uint32_t pair;                  ///< of bodies
  std::uint32_t patch_a, patch_b;      ///< counted over all bodies; none: the particles themselves touch
  std::uint32_t carrier_a, carrier_b;  ///< identities of the particles
  auto operator<=>(const TouchKey&) const = default;
  bool of_patches() const { return patch_a != none; }
};

/// A spring along two surfaces, as friction is: it stretches while they stick and follows while they slide.
struct Spring {
  double force = 0.0;      ///< N, on b, along the surface
  double stiffness = 0.0;  ///< N/m
  double energy() const { return stiffness > 0.0 ? 0.5 * force * force / stiffness : 0.0; }
};

struct Stretched {
  Spring spring;
  double lost = 0.0;  ///< J (per radian or per metre), never negative
  bool slides = false;
};

/// The spring after its ends have moved apart by `way` (m, b's against a's) while nothing could pull by more
/// than `bound`. A change of stiffness (patches come to face each other, or cease to) strains nothing: the
/// force stays where it grows, the length where it falls. An elastic, perfectly plastic law, whose return is
/// exact for a straight way: a pure and Lipschitz function of (spring, stiffness, bound, way).
inline Stretched stretch(const Spring& before, double stiffness, double bound, double way) {
  if (!(stiffness > 0.0)) return {{}, before.energy()};
  const auto bounded = [&](double force) { return std::clamp(force, -bound, bound); };
  const Spring kept{bounded(before.force * (stiffness / std::max(stiffness, before.stiffness))), stiffness};
  const double tried = kept.force - stiffness * way, force = bounded(tried);
  return {{force, stiffness},
          std::max(0.0, before.energy() - kept.energy()) + std::abs((tried - force) * force) / stiffness,
          std::abs(tried) > bound};
}

/// The spring of a touch, and how its carriers stood to each other when it was last looked at.
struct Grip {
  TouchKey key;
  Spring spring;
  Vector apart{};         ///< m, from a's carrier to b's
  double turn_a, turn_b;  ///< rad
  double side_a, side_b;  ///< whether they have become their images at the axis
};

}  // namespace vitrum::mpm
