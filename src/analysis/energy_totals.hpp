#pragma once

namespace vitrum {

/// The energy account of a run, joules (per radian in axisymmetric scenes, per metre in plane strain; outputs
/// multiply by 2 pi in axisymmetric scenes so that files hold joules of the whole body).
struct EnergyTotals {
  double initial = 0.0;  ///< kinetic + elastic at the start
  double kinetic = 0.0;
  double elastic = 0.0;
  double plastic = 0.0;     ///< dissipated so far
  double damage = 0.0;      ///< dissipated so far
  double fracture = 0.0;    ///< dissipated so far, snap-back releases included
  double snap_back = 0.0;   ///< the part of fracture that instantaneous releases dissipated beyond eq. 13
  double external = 0.0;    ///< work of gravity and prescribed velocities so far
  double max_growth = 1.0;  ///< largest (kinetic + elastic) / initial seen; 1 where initial = 0

  /// What the numerics made (negative) or destroyed (positive).
  constexpr double residual() const {
    return initial + external - (kinetic + elastic + plastic + damage + fracture);
  }
  /// residual / max(initial, |external|); 0 when both vanish.
  constexpr double relative_residual() const {
    const double work = external < 0.0 ? -external : external;
    const double scale = initial > work ? initial : work;
    return scale > 0.0 ? residual() / scale : 0.0;
  }
};

}  // namespace vitrum
