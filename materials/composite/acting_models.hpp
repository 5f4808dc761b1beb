#pragma once
#include "materials/composite/evolution.hpp"

// Of models that act together, those that go forward: flow and sliding of closed faces, flow and decohesion.

namespace vitrum {

/// Rubble whose void closes under more shear than its pressure bears follows the yield surface from its apex
/// along a straight line. (No flow has a direction at the apex itself.) What it dissipates until the end of
/// the path is booked.
template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::select_proportional([[maybe_unused]] CompositeMode& mode,
                                                      [[maybe_unused]] const CompositeState& s,
                                                      [[maybe_unused]] const StrainPath& path,
                                                      [[maybe_unused]] double fraction,
                                                      [[maybe_unused]] PointReport& report) const {
  if constexpr (C && Y == Yielding::drucker_prager) {
    mode.sheared = 1.0;
    if (mode.plane != CompositeMode::Plane::closed || !is_rubble(s) || trace(path.strain) > 0.0) return;
    if (norm(s.elastic_strain) > tolerance::rounding * norm(path.strain)) return;
    mode.sheared = share_of_shear(s, path.strain);
    if (!(mode.sheared < 1.0)) return;
    const double strain = (1.0 - fraction) * norm(deviator(path.strain));
    report.dissipation.plastic +=
        secant(false, s).shear * mode.sheared * (1.0 - mode.sheared) * strain * strain;
    if (s.plastic_strain == 0.0) report.record(EventKind::yield, fraction, stress(s));
  }
}

/// Whether closed faces that bear nothing part while the material behind them goes on.
template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::faces_part(CompositeMode mode, const CompositeState& s,
                                             const StrainPath& path, bool may_flow) const {
  mode.plane = CompositeMode::Plane::open;
  mode.slides = 0.0, mode.flowing = may_flow;
  CompositeRates r = rates(mode, s, path);
  if (may_flow && !(r.plastic_strain > 0.0)) {
    mode.flowing = false;
    r = rates(mode, s, path);
  }
  return r.opening_n > 0.0;
}

/// Of flow and sliding of closed faces, those that act: each acting one goes forward, and its surface bounds
/// the rates of the other where that one rests (a linear complementarity problem). Where a law that is not
/// associated has several solutions, the first of: neither, flow, sliding, both; where rounding leaves none,
/// what misses one by least. Both may go forward while the path goes back, the plane being driven by
/// softening: a fall. may_slide: false where sliding has just come to rest. True, and neither, where the
/// faces bear nothing and part.
template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::select_flow_and_sliding(CompositeMode& mode, const CompositeState& s,
                                                          const StrainPath& path, bool may_flow,
                                                          bool may_slide) const {
  const DecohesionPlane plane{s.normal};
  const Moduli m = secant(mode.tension, s);
  const PlaneTraction t = traction(plane, s.elastic_strain, m);
  const double rounding = tolerance::rounding * m.p_wave() * (norm(s.elastic_strain) + norm(path.strain));
  if (t.normal >= -rounding && faces_part(mode, s, path, may_flow)) return true;
  // Where the faces have just met, they may slide to either side.
  const bool at_apex = std::abs(t.tangential) <= rounding;
  const double size = std::abs(t.tangential) + std::abs(t.normal), friction = decohesion_.friction();
  const double side = t.tangential < 0.0 ? -1.0 : 1.0;
  may_slide =
      may_slide && std::abs(t.tangential) + friction * t.normal >= -tolerance::on_surface * size - rounding;
  CompositeMode tried = mode;
  tried.slides = 0.0, tried.flowing = true;
  if (may_flow && Y == Yielding::von_mises && softens_past_equilibrium(tried, s)) {
    mode = tried;  // the fall comes first
    return false;
  }
  const SymmetricTensor gradient = yield_gradient(s, m);
  const auto violation = [&] {  // of the four inequalities, as a strain per unit of the path
    const CompositeRates r = rates(tried, s, path);
    double of_slip = 0.0, of_flow = 0.0;
    if (tried.rubs()) {
      of_slip = -tried.slides * r.opening_t / s.effective_length;
    } else if (may_slide) {
      const PlaneTraction c = traction(plane, r.elastic_strain, m);
      of_slip = ((at_apex ? std::abs(c.tangential) : side * c.tangential) + friction * c.normal) / m.p_wave();
    }
    if (tried.flowing)
      of_flow = -r.plastic_strain;
    else if (may_flow)
      of_flow = contract(gradient, r.elastic_strain) / m.p_wave();
    return std::max({0.0, of_slip, of_flow});
  };
  double least = std::numeric_limits<double>::infinity();
  for (const double slides : {0.0, side, at_apex ? -side : 0.0})
    for (const bool flows : {false, true}) {
      if ((slides != 0.0 && !may_slide) || (flows && !may_flow)) continue;
      tried.slides = slides, tried.flowing = flows;
      if (const double v = violation(); v < least) least = v, mode = tried;
    }
  return false;
}

/// Of flow and decohesion, those that go forward: both together, then each alone. True where neither can go
/// on alone, and both together only backwards along the path: each drives the other, faster than the path
/// does.
template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::select_flow_and_opening(CompositeMode& mode, const CompositeState& s,
                                                          const StrainPath& path, bool may_flow,
                                                          bool may_open, bool may_slide) const {
  using Plane = CompositeMode::Plane;
  if constexpr (C) {
    mode.viscous = decohesion_.viscosity() > 0.0;
    if (may_open) {
      const Moduli m = secant(mode.tension, s);
      const PlaneTraction t = traction(DecohesionPlane{s.normal}, s.elastic_strain, m);
      if (mode.plane == Plane::held) mode.pulled = t.normal > 0.0 || decohesion_.parameters().pressure_counts;
    }
    if (mode.plane == Plane::held || mode.plane == Plane::decohering)
      mode.plane = may_open ? Plane::decohering : Plane::held;
  }
  mode.slides = 0.0;
  if constexpr (C) {
    if (mode.plane == Plane::closed && decohesion_.friction() > 0.0) {
      if (!select_flow_and_sliding(mode, s, path, may_flow, may_slide)) return false;
      mode.plane = Plane::open;
    }
  }
  bool opens_alone = false;
  if constexpr (C) {
    if (may_open) {
      // The elastic material behind the plane drives it beyond what it can bear: it snaps back whether or not
      // the material flows.
      mode.flowing = false;
      const CompositeRates alone = rates(mode, s, path);
      opens_alone = alone.decohesion > 0.0;
      if (opens_alone && !alone.advances()) return false;
    }
  }
  mode.flowing = may_flow;
  if constexpr (has_yield || C) {
    if (mode.flowing && Y == Yielding::von_mises && softens_past_equilibrium(mode, s)) {
      if (mode.decohering()) mode.plane = Plane::held;  // the fall comes first
      return false;
    }
    if (mode.flowing && mode.decohering()) {
      const CompositeRates together = rates(mode, s, path);
      const bool opens = together.decohesion > 0.0, flows = together.plastic_strain > 0.0;
      // Otherwise one goes on and relieves the other.
      if (together.advances() && opens && flows) return false;
      if (opens && !together.advances()) {
        // What flows behind the plane drives it beyond what it can bear, too.
        if (snaps_back_alone(mode, s, path)) return mode.flowing = false;
        if (Y == Yielding::von_mises && flows) return true;
      }
      // Where either would relieve the other the plane opens: after the localisation the discrete law acts.
      const bool opening_relieves = opens_alone && !flows;
      CompositeMode flow_alone = mode;
      flow_alone.plane = Plane::held;
      if (!opening_relieves && !opens && rates(flow_alone, s, path).plastic_strain > 0.0)
        mode.plane = Plane::held;
      else
        mode.flowing = false;
    }
    const CompositeRates r = rates(mode, s, path);
    if (mode.decohering() && !(r.decohesion > 0.0)) mode.plane = Plane::held;
    if (mode.flowing && !(r.plastic_strain > 0.0)) mode.flowing = false;
  }
  return false;
}

}  // namespace vitrum
