#pragma once
#include "mpm/system.hpp"

/// Points that are to leave the computation (Material::leaving_column): their particles are taken out of it
/// where positions are those of the step's end. They keep their mass and their place, and stand still, behind
/// all others in storage (Body::removed): no list of the grid has them, they are in no law's increment, and
/// what they carry of a surface touches nothing and bears no load.
namespace vitrum::mpm {

/// Whether particles of a body, or of any, can leave.
bool removes(const Body& body);
bool removes(const System& system);
/// Takes out those that are to leave; whether there are any: the grid's lists are void then. What they have,
/// and what contact stores at them, goes over from the record's energies to `removed`.
bool remove_particles(System& system);
/// What a checkpoint must say of it: how many have left, by body; empty where none can.
std::vector<double> removed_counts(const System& system);
/// Takes it up again, particles being stored as then. False: it is not this scene's.
bool restore_removed(System& system, const std::vector<double>& counts);
/// Mass of the particles that have left, kg (per radian or per metre).
double removed_mass(const Body& body);

}  // namespace vitrum::mpm
