#pragma once
#include <functional>
#include <vector>

#include "scene/surface_edges.hpp"

namespace vitrum {

using Edges = std::vector<Edge>;

/// Whether two boxes are within a distance (m) of each other, along either axis.
bool near(const Box& a, const Box& b, double reach);

/// Two sets of closed edges, a and b, cut where they meet: what is left of each edge of a, and of b.
struct Joined {
  std::vector<Edges> a;
  Edges b;
};
using Inside = std::function<bool(const Vector2&)>;
/// The edges of a or b. Points within the tolerance (m) are one.
Joined together(const Edges& a, const Inside& in_a, const Edges& b, const Inside& in_b, double tolerance);
/// The edges of a without b.
Joined without(const Edges& a, const Inside& in_a, const Edges& b, const Inside& in_b, double tolerance);

}  // namespace vitrum
