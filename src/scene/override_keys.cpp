#include "scene/override_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "scene/suggestion.hpp"
#include "scene/table_view.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

bool to_index(const std::string& key, std::size_t& index) {
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  return error == std::errc{} && end == key.data() + key.size();
}

/// The index, as a key, of the item with this `name` in a list of tables.
std::string index_of(const std::string& name, const toml::array& list, const std::string& path) {
  std::vector<std::string> names, indices;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const toml::table* item = list[i].as_table();
    const std::optional<std::string> own =
        item != nullptr ? (*item)["name"].value<std::string>() : std::nullopt;
    if (own) names.push_back(*own);
    if (own == name) indices.push_back(std::to_string(i));
  }
  if (names.empty()) return name;  // a wrong index
  const std::string key = join_path(path, name);
  if (indices.empty())
    throw Refusal{key,
                  with_suggestion(fmt::format("found no item of this name, expected one of {} or an index "
                                              "from 0 to {}",
                                              schema::quoted_list(names), list.size() - 1),
                                  name, names)};
  if (indices.size() > 1)
    throw Refusal{key, fmt::format("found {} items of this name, expected an index: one of {}",
                                   indices.size(), fmt::join(indices, ", "))};
  return indices.front();
}

}  // namespace

std::string joined(const std::vector<std::string>& keys, std::size_t count) {
  std::string path;
  for (std::size_t i = 0; i < count; ++i) path = join_path(path, keys[i]);
  return path;
}

bool is_index(std::string_view key) {
  return std::ranges::all_of(key, [](char c) { return c >= '0' && c <= '9'; });
}

std::size_t item_index(const toml::array& list, const std::vector<std::string>& keys, std::size_t depth) {
  const std::string& key = keys[depth];
  std::size_t index = 0;
  if (to_index(key, index) && index < list.size()) return index;
  const std::string range =
      list.empty() ? "the list is empty" : fmt::format("expected an index from 0 to {}", list.size() - 1);
  throw Refusal{joined(keys, depth + 1),
                fmt::format("found index {} of a list of length {}, {}", key, list.size(), range)};
}

std::vector<std::string> with_indices(const toml::table& document, const std::vector<KeyPart>& parts) {
  std::vector<std::string> keys;
  const toml::node* node = &document;
  for (const KeyPart& part : parts) {
    const toml::array* list = node != nullptr ? node->as_array() : nullptr;
    const bool by_name = list != nullptr && (part.in_quotes || !is_index(part.text));
    keys.push_back(by_name ? index_of(part.text, *list, joined(keys, keys.size())) : part.text);
    if (node == nullptr) continue;
    const toml::table* table = node->as_table();
    std::size_t index = 0;
    if (list != nullptr)
      node = to_index(keys.back(), index) ? list->get(index) : nullptr;
    else
      node = table != nullptr ? table->get(part.text) : nullptr;
  }
  return keys;
}

}  // namespace vitrum::scene
