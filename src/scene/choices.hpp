#pragma once
#include <array>
#include <string_view>

#include "scene/scene.hpp"

namespace vitrum::scene {

// Names of enumeration values in scene files, in the order of the enumerations.
inline constexpr std::array<std::string_view, 2> geometry_names{"axisymmetric", "plane-strain"};
/// Keys of the shapes, in the order of Shape.
inline constexpr std::array<std::string_view, 4> shape_names{"box", "disk", "ring", "polygon"};
inline constexpr std::array<std::string_view, 3> shape_function_names{"linear", "gimp", "bspline2"};
inline constexpr std::array<std::string_view, 3> grid_method_names{"explicit", "arkode-explicit",
                                                                   "arkode-implicit"};
inline constexpr std::array<std::string_view, 3> scheme_names{"usf", "usl", "musl"};
inline constexpr std::array<std::string_view, 2> contact_method_names{"single", "bodies"};
inline constexpr std::array<std::string_view, 3> local_method_names{"closed-form", "substep", "cvode"};
inline constexpr std::array<std::string_view, 2> linear_solver_names{"klu", "gmres"};
inline constexpr std::array<std::string_view, 2> preconditioner_names{"factor", "diagonal"};
inline constexpr std::array<std::string_view, 2> local_solver_names{"bdf", "adams"};
inline constexpr std::array<std::string_view, 2> flow_names{"isochoric", "associated"};
inline constexpr std::array<std::string_view, 2> plane_names{"in-plane", "all"};
inline constexpr std::array<std::string_view, 1> rate_names{"running-maximum"};

/// Components of a vector as `fix` names them.
constexpr std::array<std::string_view, 2> component_names(Geometry geometry) {
  return geometry == Geometry::axisymmetric ? std::array<std::string_view, 2>{"r", "z"}
                                            : std::array<std::string_view, 2>{"x", "y"};
}

/// The name of an enumeration value (or of a bool: its second name when true).
template <class Value, std::size_t N>
constexpr std::string_view name_of(const std::array<std::string_view, N>& names, Value value) {
  return names[static_cast<std::size_t>(value)];
}

}  // namespace vitrum::scene
