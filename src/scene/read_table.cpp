#include "scene/read_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>

#include "scene/read_value.hpp"
#include "scene/suggestion.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

using schema::Alternatives;
using schema::Key;
using schema::Kind;
using schema::Numbers;
using schema::Value;

/// Of keys of which at most one may be given, each but the first of the file is reported.
void check_at_most_one(const TableView& table, std::vector<std::string> given) {
  std::ranges::stable_sort(given, {}, [&](const std::string& key) {
    const toml::source_position at = table.position(key);
    return std::tuple(at.line, at.column);
  });
  for (std::size_t i = 1; i < given.size(); ++i)
    table.report(given[i], fmt::format("found together with '{}', expected only one of the two",
                                       join_path(table.path(), given[0])));
}

void check_alternatives(const TableView& table, const Alternatives& group) {
  std::vector<std::string> given;
  std::ranges::copy_if(group.keys, std::back_inserter(given),
                       [&](const std::string& key) { return table.has(key); });
  if (group.needed.empty()) return check_at_most_one(table, given);
  if (given.size() != 1)
    table.report(fmt::format("found {}, expected exactly one of {}",
                             given.empty() ? "no " + group.needed : schema::quoted_list(given),
                             fmt::join(group.keys, ", ")));
}

void check_keys(const TableView& table) {
  const std::vector<std::string> names = table.schema().names();
  for (const auto& [key, node] : table.toml()) {
    if (std::ranges::find(names, key.str()) != names.end()) continue;
    const std::string path = join_path(table.path(), key.str());
    const std::string fact = fmt::format("found an unknown key, expected {}{}",
                                         names.size() > 1 ? "one of " : "", fmt::join(names, ", "));
    table.diagnostics().add(path, key.source().begin, path, with_suggestion(fact, key.str(), names));
  }
  // (A preset that is still there is none: it would have given what is required.)
  const std::string& filled_by = table.schema().filled_by;
  const bool would_be_filled = !filled_by.empty() && table.has(filled_by);
  for (const Key& key : table.schema().keys)
    if (key.required && !would_be_filled && !table.has(key.name))
      table.report(key.name, fmt::format("found nothing, expected {}", expected(key)));
  for (const Alternatives& group : table.schema().alternatives) check_alternatives(table, group);
}

void read_tables(const TableView& table, const Key& key, const toml::array& list, void* owner) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!list[i].is_table())
      table.fail_node(list[i], join_path(join_path(table.path(), key.name), i), "a table");
  for (const TableView& one : table.tables(key.name)) read_table(one, key.open(owner, ""));
}

void read_named_tables(const TableView& table, const Key& key, const toml::table& tables, void* owner) {
  for (const std::string& name : names_in_order(tables)) {
    const toml::node& node = *tables.get(name);
    const std::string path = join_path(join_path(table.path(), key.name), name);
    if (name.empty() || has_control_characters(name))
      table.diagnostics().add(
          path, node.source().begin, path,
          fmt::format("found {}, expected a name that is not empty, without line breaks or other control "
                      "characters",
                      name.empty() ? "an empty name" : "control characters in the name"));
    if (const toml::table* one = node.as_table())
      read_table({*one, path, *key.table, table.diagnostics(), table.formulas()}, key.open(owner, name));
    else
      table.fail_node(node, path, "a table " + key.table->heading);
  }
}

/// Reads a key that holds tables. False: the node is none that it could hold.
bool read_as_tables(const TableView& table, const Key& key, const toml::node& node, void* owner) {
  const toml::array* list = node.as_array();
  const toml::table* tables = node.as_table();
  if (key.shape.kind == Kind::tables) {
    const bool in_one_line = key.table->in_one_line;
    if (in_one_line && tables != nullptr) {  // {..} for [{..}]
      read_table(table.tables(key.name).front(), key.open(owner, ""));
      return true;
    }
    if (list == nullptr || ((key.required || in_one_line) && list->empty())) return false;
    read_tables(table, key, *list, owner);
  } else if (tables == nullptr || (key.shape.kind == Kind::named_tables && tables->empty())) {
    return false;
  } else if (key.shape.kind == Kind::named_tables) {
    read_named_tables(table, key, *tables, owner);
  } else {
    read_table(*table.table(key.name), key.open(owner, ""));
  }
  return true;
}

void read_key(const TableView& table, const Key& key, const toml::node& node, void* owner) {
  if (key.table != nullptr && read_as_tables(table, key, node, owner)) return;
  if (const std::optional<Value> value = read_value(table, key, node)) key.set(owner, *value);
}

}  // namespace

void read_table(const TableView& table, void* owner) {
  check_keys(table);
  for (const Key& key : table.schema().keys) {
    if (const toml::node* node = table.toml().get(key.name))
      read_key(table, key, *node, owner);
    else if (key.fallback && std::ranges::none_of(table.schema().alternatives_of(key.name),
                                                  [&](const std::string& other) { return table.has(other); }))
      key.set(owner, *key.fallback);
  }
}

}  // namespace vitrum::scene
