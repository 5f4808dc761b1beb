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

const schema::Function* Scene::function(const std::string& path) const {
  const auto found = functions.find(path);
  return found != functions.end() ? &found->second : nullptr;
}

bool Scene::varies(const std::string& path) const {
  // '/' follows '.'.
  return functions.contains(path) || functions.lower_bound(path + '.') != functions.lower_bound(path + '/');
}

const MaterialParameters& Scene::material_of(std::size_t body) const {
  return *std::find_if(materials.begin(), materials.end(),
                       [&](const MaterialParameters& m) { return m.name == bodies[body].material; });
}

std::vector<Vector2> ProbeDefinition::points() const {
  if (const auto* point = std::get_if<Vector2>(&place)) return {*point};
  const auto& line = std::get<ProbeLine>(place);
  std::vector<Vector2> points;
  for (int k = 0; k < line.count; ++k) {
    const double part = static_cast<double>(k) / (line.count - 1);
    points.push_back({line.from[0] + part * (line.to[0] - line.from[0]),
                      line.from[1] + part * (line.to[1] - line.from[1])});
  }
  return points;
}

}  // namespace vitrum
