#include "scene/table_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "scene/toml_text.hpp"

namespace vitrum::scene {

constexpr std::size_t longest_quoted_text = 64;  // a SHA-256

std::string found_text(const toml::node& node) {
  if (const auto* text = node.as_string()) {
    const std::string& value = text->get();
    return value.size() <= longest_quoted_text ? toml_quoted(value)
                                               : fmt::format("a string of {} bytes", value.size());
  }
  if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
  if (const auto* real = node.as_floating_point()) return number_text(real->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (const auto* list = node.as_array())
    return list->empty() ? "an empty list" : fmt::format("a list of {}", list->size());
  return node.is_table() ? "a table" : "a date or time";
}

bool TableView::sound(std::string_view key) const {
  return diagnostics_->sound(join_path(path_, key));
}

toml::source_position TableView::position(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node != nullptr ? node->source().begin : toml::source_position{};
}

const toml::node& TableView::place_of(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node != nullptr ? *node : *table_;
}

void TableView::fail_node(const toml::node& node, const std::string& path, std::string_view expected) const {
  diagnostics_->add(path, node.source().begin, path,
                    fmt::format("found {}, expected {}", found_text(node), expected));
}

void TableView::fail(std::string_view key, std::string_view expected) const {
  const toml::node* node = table_->get(key);
  report(key,
         fmt::format("found {}, expected {}", node != nullptr ? found_text(*node) : "nothing", expected));
}

void TableView::report(std::string_view key, std::string_view fact) const {
  const std::string path = join_path(path_, key);
  diagnostics_->add(path, place_of(key).source().begin, path, fact);
}

void TableView::warn(std::string_view key, std::string_view fact) const {
  const std::string path = join_path(path_, key);
  diagnostics_->warn(has(key) ? path : path_, place_of(key).source().begin, path, fact);
}

void TableView::report(std::string_view fact) const {
  diagnostics_->add(path_, table_->source().begin, path_, fact);
}

std::optional<TableView> TableView::table(std::string_view key) const {
  const toml::node* node = table_->get(key);
  if (node == nullptr || !node->is_table()) return std::nullopt;
  return TableView(*node->as_table(), join_path(path_, key), *schema_->find(key)->table, *diagnostics_,
                   *formulas_);
}

std::vector<TableView> TableView::tables(std::string_view key) const {
  std::vector<TableView> views;
  const schema::Key& row = *schema_->find(key);
  const std::string path = join_path(path_, key);
  const auto add = [&](const toml::node& node, const std::string& path_of_node) {
    if (const toml::table* table = node.as_table())
      views.emplace_back(*table, path_of_node, *row.table, *diagnostics_, *formulas_);
  };
  const toml::node* node = table_->get(key);
  if (node != nullptr && node->is_array() && row.shape.kind == schema::Kind::tables)
    for (std::size_t i = 0; i < node->as_array()->size(); ++i)
      add(*node->as_array()->get(i), join_path(path, i));
  if (node != nullptr && node->is_table() && row.shape.kind == schema::Kind::tables && row.table->in_one_line)
    add(*node, path);
  if (node != nullptr && node->is_table() && row.shape.kind == schema::Kind::named_tables)
    for (const std::string& name : names_in_order(*node->as_table()))
      add(*node->as_table()->get(name), join_path(path, name));
  return views;
}

std::vector<std::string> names_in_order(const toml::table& tables) {
  // toml++ sorts keys by name; the file's order is in their positions, which what comes from --set lacks.
  std::vector<toml::key> keys;
  for (const auto& [key, unused] : tables) keys.push_back(key);
  std::ranges::stable_sort(keys, {}, [](const toml::key& key) {
    const toml::source_position at = key.source().begin;
    return std::tuple(at.line == 0, at.line, at.column);
  });
  std::vector<std::string> names;
  for (const toml::key& key : keys) names.emplace_back(key.str());
  return names;
}

}  // namespace vitrum::scene
