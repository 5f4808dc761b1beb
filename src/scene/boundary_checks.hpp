#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vitrum {

/// The first time (s) at which two boundaries hold the same nodes in the same component at different
/// velocities while neither has priority; nothing: they never do.
std::optional<double> contradiction(const Scene& scene, const BoundaryDefinition& a,
                                    const BoundaryDefinition& b);

/// What is valid but hardly meant: boxes between the rows of nodes.
std::vector<std::string> boundary_warnings(const Scene& scene);

}  // namespace vitrum
