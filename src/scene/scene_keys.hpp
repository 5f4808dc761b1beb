#pragma once
#include "materials/registry.hpp"
#include "scene/key_info.hpp"
#include "scene/scene.hpp"

/// The keys of every table of scene and point files: one source for the reader, its messages and the scene
/// reference.
namespace vitrum::scene::keys {

/// Fraction of the critical step that explicit schemes use when the scene gives neither `step` nor `courant`.
inline constexpr double default_courant = 0.4;

// The document and its sections.
KeyTable scene();
KeyTable point();
KeyTable state();
KeyTable space();
KeyTable time();
KeyTable integrator();
KeyTable constitutive();
KeyTable output();
KeyTable gravity();
KeyTable contact();
KeyTable contact_pair();
KeyTable path();

// [[body]], its shapes, and [[boundary]].
KeyTable body();
KeyTable box();
KeyTable disk();
KeyTable ring();
KeyTable perturbation();
/// The names in `fix` depend on the geometry.
KeyTable boundary(Geometry geometry);
KeyTable boundary_box();

// [material.NAME] and its models.
KeyTable material();
KeyTable damage();
KeyTable fixed_rate();
KeyTable drucker_prager();
KeyTable von_mises();
KeyTable decohesion();
/// [material.NAME.TABLE] of a registered law.
KeyTable law(const RegisteredLaw& law);

/// Names that `output.fields` admits.
const std::vector<std::string>& output_fields();

}  // namespace vitrum::scene::keys
