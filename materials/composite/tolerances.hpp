#pragma once

/// Where the composite takes one number for another. Relative to what they stand beside in the code.
namespace vitrum::tolerance {

/// Stress this close to the yield surface (of 2G |dev e|), or traction to the strength of the plane, is on
/// it.
inline constexpr double on_surface = 1e-9;
/// A crack density below that of eq. 7 by less, of a state that was written and read.
inline constexpr double written = 1e-9;
/// What sums and quotients of a few terms leave: crack densities that are equal, a decohesion of 1, strength
/// that is spent, a fraction of an increment that is nothing.
inline constexpr double rounding = 1e-12;
/// The same of one traction.
inline constexpr double traction_rounding = 1e-13;
/// What an equilibrium of the plane that was solved for may be off, and what pushes it over the edge.
inline constexpr double equilibrium = 1e-10;
/// A fraction of an increment, or of a step, below which a change is a jump.
inline constexpr double jump = 1e-6;
/// Share of the elastic stiffness below which a surface softens next to a snap-back: no correction there.
inline constexpr double ill_posed = 1e-3;
/// The largest correction of the decohesion that is one of drift.
inline constexpr double drift = 1e-2;

}  // namespace vitrum::tolerance
