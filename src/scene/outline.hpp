#pragma once
#include <vector>

#include "scene/surface_edges.hpp"

namespace vitrum {

/// The edges of shapes that are put together or cut out, each with the body to its left: those of the shapes,
/// cut where they cross, without what lies inside others. Closed, but for what is shorter than 1e-12 of the
/// region. Throws InputError where shapes touch in a way that cannot be told from crossing.
std::vector<Edge> outline(const Region& region);

/// The edges of an image's pixels, those in a row as one.
std::vector<Edge> outline(const Image& image);

}  // namespace vitrum
