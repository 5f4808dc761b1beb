#pragma once
#include "materials/composite/closed_form.hpp"

// What a given state asks for at the instant at which it is given.

namespace vitrum {

template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::judge([[maybe_unused]] CompositeState& s,
                                         [[maybe_unused]] PointReport& report) const {
  if constexpr (dissipates) {
    if constexpr (D)
      if (!is_localised(s)) damage_at_once(s, 0.0, report);
    CompositeMode mode;
    mode.tension = trace(s.elastic_strain) > 0.0;
    if constexpr (C)
      if (is_localised(s)) mode = localised_mode(s);
    fall_to_admissible_stress(mode, s, 0.0, report);
    if constexpr (C)
      if (is_localised(s) && is_overloaded(localised_mode(s), s))
        release_plane_at_once(s, Jump::snap_back, false, 0.0, report);
  }
}

}  // namespace vitrum
