#pragma once
#include <cstdint>

namespace vitrum::mpm {

/// A component of a node's velocity that is not free.
struct Constraint {
  static constexpr std::int16_t free = -1, axis = -2;  ///< otherwise: index of the boundary
};

/// A node of a tile behind a plane of symmetry and the node that it is the image of: what the image collects
/// goes to the node, and the image moves as the node does, but for the sign of the component across the
/// plane.
struct Image {
  std::uint8_t entry, node;  ///< entries of the tile
  std::uint8_t component;    ///< across the plane
  std::int16_t by;           ///< the boundary that is the plane, or Constraint::axis
};

/// What an image had collected when it was folded onto its node: kg, and N across the plane (per radian or
/// per metre).
struct ImageSums {
  double mass, force;
};

}  // namespace vitrum::mpm
