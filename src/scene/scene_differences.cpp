#include "scene/scene_differences.hpp"

#include <fmt/format.h>

#include <map>

#include "scene/table_view.hpp"
#include "scene/toml_text.hpp"

namespace vitrum {
namespace {

using Values = std::map<std::string, std::string>;

/// Enters every value below `node` by its path.
void gather(const toml::node& node, const std::string& path, Values& values) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table) gather(value, scene::join_path(path, key.str()), values);
  } else if (const toml::array* list = node.as_array()) {
    for (std::size_t i = 0; i < list->size(); ++i) gather((*list)[i], scene::join_path(path, i), values);
  } else {
    values[path] = scene::found_text(node);
  }
}

Values values_of(std::string_view scene) {
  Values values;
  gather(toml::parse(scene, std::string_view{}), "", values);
  return values;
}

}  // namespace

std::vector<std::string> scene_differences(std::string_view found, std::string_view expected) {
  const Values ours = values_of(found);
  Values theirs = values_of(expected);
  std::vector<std::string> differences;
  const auto differ = [&](const std::string& key, const std::string& one, const std::string& other) {
    differences.push_back(fmt::format("key '{}': found {}, expected {}", key, one, other));
  };
  for (const auto& [key, value] : ours) {
    const auto other = theirs.find(key);
    if (other == theirs.end()) {
      differ(key, value, "nothing");
    } else {
      if (other->second != value) differ(key, value, other->second);
      theirs.erase(other);
    }
  }
  for (const auto& [key, value] : theirs) differ(key, "nothing", value);
  return differences;
}

}  // namespace vitrum
