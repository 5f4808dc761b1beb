#include <fmt/format.h>

#include <algorithm>

#include "scene/suggestion.hpp"
#include "scene/toml_reader.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {

const toml::array* TableReader::list(std::string_view key) const {
  const KeyInfo& info = find_key(keys_, key);
  const toml::node* node = table_->get(key);
  if (node == nullptr) return nullptr;
  if (!node->is_array()) fail(key, info.expected);
  return node->as_array();
}

std::optional<std::vector<double>> TableReader::numbers(const toml::array& list, const std::string& path,
                                                        const KeyInfo& info) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const toml::node& item = list[i];
    if (const auto value = checked_number(item, join_path(path, i), info.bounds, info.component))
      values.push_back(*value);
  }
  if (values.size() != list.size()) return std::nullopt;
  return values;
}

bool TableReader::read(std::string_view key, std::span<double> components) const {
  const toml::array* items = list(key);
  if (items == nullptr) return false;
  const KeyInfo& info = find_key(keys_, key);
  if (items->size() != components.size()) {
    fail(key, info.expected);
    return false;
  }
  const auto values = numbers(*items, join_path(path_, key), info);
  if (values) std::ranges::copy(*values, components.begin());
  return values.has_value();
}

bool TableReader::read(std::string_view key, std::vector<double>& values) const {
  const toml::array* items = list(key);
  if (items == nullptr) return false;
  auto result = numbers(*items, join_path(path_, key), find_key(keys_, key));
  if (result) values = std::move(*result);
  return result.has_value();
}

bool TableReader::read_rows(std::string_view key, std::size_t length,
                            std::vector<std::vector<double>>& rows) const {
  const toml::array* items = list(key);
  if (items == nullptr) return false;
  std::vector<std::vector<double>> result;
  for (std::size_t i = 0; i < items->size(); ++i) {
    const std::string path = join_path(join_path(path_, key), i);
    const toml::array* row = (*items)[i].as_array();
    if (row == nullptr || row->size() != length)
      fail_node((*items)[i], path, fmt::format("a list of {} numbers", length));
    else if (auto values = numbers(*row, path, find_key(keys_, key)))
      result.push_back(std::move(*values));
  }
  if (result.size() != items->size()) return false;
  rows = std::move(result);
  return true;
}

bool TableReader::read(std::string_view key, std::vector<std::string>& texts) const {
  const toml::array* items = list(key);
  if (items == nullptr) return false;
  const std::vector<std::string>& choices = find_key(keys_, key).choices;
  std::vector<std::string> result;
  for (std::size_t i = 0; i < items->size(); ++i) {
    const toml::node& item = (*items)[i];
    const std::string path = join_path(join_path(path_, key), i);
    const std::string text = item.value_or(std::string());
    if (std::ranges::find(choices, text) == choices.end())
      fail_node(item, path, with_suggestion("one of " + quoted_list(choices), text, choices));
    else if (std::ranges::find(result, text) != result.end())
      fail_node(item, path, "every entry once");
    else
      result.push_back(text);
  }
  if (result.size() != items->size()) return false;
  texts = std::move(result);
  return true;
}

std::vector<TableReader> TableReader::tables(std::string_view key, KeyTable keys) const {
  std::vector<TableReader> readers;
  const toml::array* items = list(key);
  if (items == nullptr) return readers;
  for (std::size_t i = 0; i < items->size(); ++i) {
    const std::string path = join_path(join_path(path_, key), i);
    if (const toml::table* child = (*items)[i].as_table())
      readers.emplace_back(*child, path, keys, *diagnostics_);
    else
      fail_node((*items)[i], path, "a table");
  }
  return readers;
}

}  // namespace vitrum::scene
