#pragma once
#include "scene/scene.hpp"
#include "schema/field.hpp"

namespace vitrum::scene {

using schema::name_of;
using schema::Named;

// What scene files call the values of enumerations.
inline constexpr std::array geometries{Named{"axisymmetric", Geometry::axisymmetric},
                                       Named{"plane-strain", Geometry::plane_strain}};
inline constexpr std::array shape_functions{
    Named{"linear", mpm::ShapeKind::linear}, Named{"gimp", mpm::ShapeKind::gimp},
    Named{"cpgimp", mpm::ShapeKind::cpgimp}, Named{"bspline2", mpm::ShapeKind::bspline2}};
inline constexpr std::array gradients{Named{"nodes", Gradients::nodes},
                                      Named{"centroids", Gradients::centroids}};
inline constexpr std::array filters{Named{"none", Filter::none}, Named{"pressures", Filter::pressures}};
inline constexpr std::array contact_methods{Named{"single", ContactMethod::single},
                                            Named{"bodies", ContactMethod::bodies}};
/// Whether eps_v of eq. 7 is the volumetric strain.
inline constexpr std::array damage_strains{Named{"mean", false}, Named{"volumetric", true}};
inline constexpr std::array damage_rates{Named{"running-maximum", DamageRate::running_maximum},
                                         Named{"current", DamageRate::current},
                                         Named{"maximum-any-sign", DamageRate::maximum_any_sign}};
/// Whether c of eq. 7 is the speed of pressure waves.
inline constexpr std::array damage_wave_speeds{Named{"bar", false}, Named{"pressure-wave", true}};
/// Whether E of eq. 10 is that of the virgin material.
inline constexpr std::array cohesive_moduli{Named{"damaged", false}, Named{"undamaged", true}};
inline constexpr std::array separated_points{
    Named{"faces", Separated::faces}, Named{"pressure", Separated::pressure},
    Named{"drucker-prager", Separated::drucker_prager}, Named{"nothing", Separated::nothing},
    Named{"removed", Separated::removed}};
/// Whether the flow is associated.
inline constexpr std::array flows{Named{"isochoric", false}, Named{"associated", true}};
/// Whether the search for a decohesion plane goes beyond the plane of the scene.
inline constexpr std::array planes{Named{"in-plane", false}, Named{"all", true}};

/// Keys of the shapes, in the order of Shape.
inline constexpr std::array<std::string_view, 6> shape_names{"box",     "disk",  "ring",
                                                             "polygon", "image", "union"};
/// Those that are one shape.
inline constexpr std::size_t simple_shapes = 5;

inline constexpr std::array sides{Named{"top", Side::top},     Named{"bottom", Side::bottom},
                                  Named{"left", Side::left},   Named{"right", Side::right},
                                  Named{"inner", Side::inner}, Named{"outer", Side::outer}};

/// Components of a vector as `fix` names them.
constexpr std::array<std::string_view, 2> component_names(Geometry geometry) {
  return geometry == Geometry::axisymmetric ? std::array<std::string_view, 2>{"r", "z"}
                                            : std::array<std::string_view, 2>{"x", "y"};
}

}  // namespace vitrum::scene
