#pragma once
#include <Eigen/Core>
#include <cmath>

#include "materials/material_parameters.hpp"

// Tangents of the paper's models written out, to compare with.

namespace vitrum::test {

/// Maps strain to stress in the order (rr, zz, tt, rz), tensor shear: stress = T strain. The column of rz
/// counts both shears.
using Tangent = Eigen::Matrix4d;

inline Eigen::Vector4d vector(const SymmetricTensor& a) {
  return {a.rr, a.zz, a.tt, a.rz};
}
/// The row that gives a : b from the column (b_rr, b_zz, b_tt, b_rz).
inline Eigen::RowVector4d contraction(const SymmetricTensor& a) {
  return {a.rr, a.zz, a.tt, 2.0 * a.rz};
}

/// E of isotropic elasticity.
inline Tangent elastic_tangent(const Moduli& m) {
  Tangent T = Tangent::Zero();
  T.topLeftCorner<3, 3>().setConstant(m.bulk - 2.0 / 3.0 * m.shear);
  T.diagonal().array() += 2.0 * m.shear;
  return T;
}

/// T^ed of eq. 9 while damage grows at a constant rate R: secant plus the loss of stiffness along the mean
/// strain. x = 16 rho_d / 9; e: elastic strain with positive trace.
inline Tangent damage_tangent(const DamageLaw& law, double x, const SymmetricTensor& e) {
  const Moduli slope = law.moduli_derivative(x);
  const double t = trace(e);
  // x' = m x tr(e') / tr(e) on eq. 7, so sigma' = E_ed : e' + (dE_ed/dx : e) x'.
  const SymmetricTensor loss =
      (law.exponent() * x / t) * (slope.bulk * t * identity() + 2.0 * slope.shear * deviator(e));
  return elastic_tangent(law.moduli(x)) + vector(loss) * contraction(identity());
}

/// T of eq. 24 on the yield surface. stress: Pa; plastic_strain: I.
inline Tangent von_mises_tangent(const VonMisesLaw& law, const Moduli& m, const SymmetricTensor& stress,
                                 double plastic_strain) {
  const SymmetricTensor s = deviator(stress);
  const double H = law.tangent_drop(m.shear, plastic_strain) / contract(s, s);
  return elastic_tangent(m) - H * vector(s) * contraction(s);
}

/// Continuum tangent of eq. 19 on the yield surface.
inline Tangent drucker_prager_tangent(const DruckerPragerParameters& p, const Moduli& m,
                                      const SymmetricTensor& stress) {
  const SymmetricTensor s = deviator(stress);
  const double q = std::sqrt(1.5 * contract(s, s)), dilatancy = p.associated ? p.beta : 0.0;
  // f' = (3G/q) s : e' + beta K tr(e'); the return takes (3G/q) s - K beta_psi I (tension positive) per unit
  // multiplier.
  const SymmetricTensor gradient = (3.0 * m.shear / q) * s + (p.beta * m.bulk) * identity();
  const SymmetricTensor direction = (3.0 * m.shear / q) * s + (dilatancy * m.bulk) * identity();
  return elastic_tangent(m) -
         vector(direction) * contraction(gradient) / (3.0 * m.shear + m.bulk * p.beta * dilatancy);
}

}  // namespace vitrum::test
