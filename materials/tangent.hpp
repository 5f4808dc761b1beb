#pragma once
#include <Eigen/Core>

#include "materials/material_parameters.hpp"

namespace vitrum {

/// Maps strain to stress in the order (rr, zz, tt, rz), tensor shear: stress = T strain. The column of rz
/// counts both shears.
using Tangent = Eigen::Matrix4d;

/// E of isotropic elasticity.
Tangent elastic_tangent(const Moduli& moduli);
/// T^ed of eq. 9 while damage grows at a constant rate R: secant plus the loss of stiffness along the mean
/// strain. x = 16 rho_d / 9; elastic_strain: with positive trace.
Tangent damage_tangent(const DamageLaw& law, double x, const SymmetricTensor& elastic_strain);
/// T of eq. 24 on the yield surface. stress: Pa; plastic_strain: I.
Tangent von_mises_tangent(const VonMisesLaw& law, const Moduli& moduli, const SymmetricTensor& stress,
                          double plastic_strain);
/// Continuum tangent of eq. 19 on the yield surface.
Tangent drucker_prager_tangent(const DruckerPragerParameters& parameters, const Moduli& moduli,
                               const SymmetricTensor& stress);

}  // namespace vitrum
