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
  return list;
}

}  // namespace vitrum::app
