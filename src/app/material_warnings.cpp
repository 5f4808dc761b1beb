#include "app/material_warnings.hpp"

#include <fmt/format.h>

namespace vitrum::app {

std::vector<std::string> material_warnings(const MaterialParameters& m) {
  std::vector<std::string> list;
  const bool localises = m.damage || (m.von_mises && m.von_mises->softening > 0.0);
  if (m.decohesion && !localises)
    list.push_back(fmt::format(
        "material.{}.decohesion: it can never begin: nothing localises this material (damage does, and "
        "von_mises with softening > 0)",
        m.name));
  // d(lambda)/dt is (1 - traction / strength) / viscosity and grows like lambda^q from lambda = 0: for q < 1
  // both the plane that waits and the one that opens at once solve it.
  if (m.decohesion && m.decohesion->viscosity > 0.0 && m.decohesion->q < 1.0)
    list.push_back(fmt::format(
        "material.{}.decohesion.q: with {:g}, below 1, the traction falls infinitely fast at first, so that "
        "with a viscosity the equations leave open when decohesion begins: methods and tolerances may differ "
        "in it; expected q >= 1, or viscosity = 0",
        m.name, m.decohesion->q));
  return list;
}

}  // namespace vitrum::app
