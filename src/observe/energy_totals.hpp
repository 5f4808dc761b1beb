#pragma once

#include <algorithm>

namespace vitrum {

/// J. Squares of smaller velocities are no longer numbers with all digits.
inline constexpr double least_energy = 1e-280;

/// The energy account of a run, joules (per radian in axisymmetric scenes, per metre in plane strain; outputs
/// multiply by 2 pi in axisymmetric scenes so that files hold joules of the whole body).
struct EnergyTotals {
  double initial = 0.0;  ///< kinetic + elastic at the start
  double kinetic = 0.0;
  double elastic = 0.0;
  double plastic = 0.0;       ///< dissipated so far
  double damage = 0.0;        ///< dissipated so far
  double fracture = 0.0;      ///< dissipated so far, snap-back releases included
  double snap_back = 0.0;     ///< the part of fracture that instantaneous releases dissipated beyond eq. 13
  double external = 0.0;      ///< work of gravity, tractions and prescribed velocities so far
  double max_growth = 1.0;    ///< largest (kinetic + elastic) / initial seen; 1 where initial = 0
  double largest_work = 0.0;  ///< largest |external| so far
  double rounding = 0.0;      ///< what rounding makes of the scene's own energies
  double contact = 0.0;       ///< stored between bodies
  double friction = 0.0;      ///< dissipated between bodies so far
  double filtered = 0.0;      ///< removed by the filters so far
  double removed = 0.0;       ///< gone with particles that left so far

  /// What the numerics made (negative) or destroyed (positive).
  constexpr double residual() const {
    return initial + external -
           (kinetic + elastic + contact + plastic + damage + fracture + friction + filtered + removed);
  }
  /// What the residual is relative to: the energy that the scene began with or was given. What is taken back
  /// from it later does not count: a body that swings or a wall that returns ends with no work at all.
  constexpr double scale() const { return std::max({initial, largest_work, rounding}); }
  /// residual / scale; 0 where there is no energy.
  constexpr double relative_residual() const { return scale() > least_energy ? residual() / scale() : 0.0; }
};

/// What an energy account says of its run.
enum class EnergyAccount { closes, open, meaningless };

/// open: the numerics made or destroyed more than a twentieth; meaningless: more than all there was.
/// `tolerated` (J, as the totals) is what the integrator may be wrong by.
constexpr EnergyAccount judge(const EnergyTotals& t, double tolerated) {
  const double allowance = std::max(tolerated, t.rounding), scale = std::max(t.scale(), allowance);
  const double error = t.residual() < 0.0 ? -t.residual() : t.residual();
  if (scale <= least_energy || (error <= allowance && t.elastic >= -allowance)) return EnergyAccount::closes;
  constexpr double open = 0.05, rounding = 1e-9;
  if (t.elastic < -rounding * scale || !(error <= scale)) return EnergyAccount::meaningless;
  return error <= open * scale ? EnergyAccount::closes : EnergyAccount::open;
}

}  // namespace vitrum
