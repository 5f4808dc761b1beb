#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vitrum {

std::string Scene::at(const std::string& key) const {
  std::string fact = fmt::format("key '{}'", key);
  for (std::string path = key; !path.empty();) {
    if (const auto place = places.find(path); place != places.end())
      return fmt::format("{}: {}", place->second, fact);
    const std::size_t dot = path.find_last_of('.');
    path.resize(dot == std::string::npos ? 0 : dot);
  }
  return fact;
}

const MaterialParameters& Scene::material_of(std::size_t body) const {
  return *std::find_if(materials.begin(), materials.end(),
                       [&](const MaterialParameters& m) { return m.name == bodies[body].material; });
}

}  // namespace vitrum
