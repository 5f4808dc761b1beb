#include "scene/overrides.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "scene/key_depth.hpp"
#include "scene/override_keys.hpp"
#include "scene/override_text.hpp"
#include "scene/scene_tables.hpp"
#include "scene/suggestion.hpp"
#include "scene/table_view.hpp"
#include "scene/toml_text.hpp"
#include "scene/write_table.hpp"

namespace vitrum::scene {
namespace {

/// In place of a value: takes the key away. No TOML value, so that none can be meant instead.
constexpr std::string_view removal = "none";

template <class Parent, class Where>
void store(Parent& parent, const Where& where, toml::node& value) {
  value.visit([&](auto& concrete) {
    if constexpr (std::is_same_v<Parent, toml::table>)
      parent.insert_or_assign(where, std::move(concrete));
    else
      parent.replace(parent.cbegin() + static_cast<std::ptrdiff_t>(where), std::move(concrete));
  });
}

/// Where the walk along the keys ends: `depth` keys lead to `parent`, the last table or list that exists.
struct Place {
  toml::node* parent;
  std::size_t depth;
};

/// The table that may stand where the first `count` keys lead; null: none.
const schema::Table* table_at(const std::vector<std::string>& keys, std::size_t count) {
  const schema::Table* table = &scene_table(Geometry::axisymmetric);
  for (std::size_t i = 0; i < count && table != nullptr; ++i) {
    const schema::Key* key = table->find(keys[i]);
    if (key != nullptr && (key->shape.kind == schema::Kind::tables || key->table_name))
      ++i;  // an item's name
    table = key != nullptr ? key->table : nullptr;
  }
  return table;
}

/// The list that a key stands for when it is absent: `body.0.velocity`, say.
std::optional<toml::array> absent_list(const std::vector<std::string>& keys, std::size_t depth) {
  const schema::Table* table = table_at(keys, depth);
  const schema::Key* key = table != nullptr ? table->find(keys[depth]) : nullptr;
  if (key == nullptr || !key->fallback) return std::nullopt;
  const toml::table document = toml::parse("list = " + value_text(*key->fallback), std::string_view{});
  const toml::array* list = document["list"].as_array();
  return list != nullptr ? std::optional(*list) : std::nullopt;
}

/// Puts `value` at the item of `list` that the keys from `depth` on name.
void put_item(toml::array& list, const std::vector<std::string>& keys, std::size_t depth, toml::node& value) {
  const std::size_t index = item_index(list, keys, depth);
  if (depth + 1 == keys.size()) return store(list, index, value);
  toml::array* row = list.get_as<toml::array>(index);
  if (row == nullptr)
    throw Refusal{joined(keys, depth + 1),
                  fmt::format("found a number, expected a list that could hold '{}'", keys[depth + 1])};
  put_item(*row, keys, depth + 1, value);
}

/// Looks without touching, so that a refused argument leaves no half-made tables behind.
Place find_place(toml::table& document, const std::vector<std::string>& keys) {
  toml::node* node = &document;
  for (std::size_t depth = 0;; ++depth) {
    const bool at_last = depth + 1 == keys.size();
    if (toml::array* list = node->as_array()) {
      const std::size_t index = item_index(*list, keys, depth);
      if (at_last) return {node, depth};
      node = list->get(index);
    } else if (toml::table* table = node->as_table()) {
      toml::node* child = table->get(keys[depth]);
      if (at_last) return {node, depth};
      if (child == nullptr && is_index(keys[depth + 1]) && !absent_list(keys, depth)) {
        const std::string path = joined(keys, depth + 1);
        throw Refusal{
            path,
            fmt::format("found nothing to index, expected a list; give it whole: --set '{}=[..]'", path)};
      }
      if (child == nullptr) return {node, depth};
      node = child;
    } else {
      throw Refusal{joined(keys, depth),
                    fmt::format("found {}, expected a table or list that could hold '{}'", found_text(*node),
                                keys[depth])};
    }
  }
}

/// Puts `value` at `keys` and returns the path of the topmost thing that is new.
std::string assign(toml::table& document, const std::vector<std::string>& keys, toml::node& value) {
  const Place place = find_place(document, keys);
  if (toml::array* list = place.parent->as_array()) {
    store(*list, item_index(*list, keys, place.depth), value);
  } else {
    toml::table* table = place.parent->as_table();
    if (place.depth + 1 < keys.size() && is_index(keys[place.depth + 1])) {
      if (std::optional<toml::array> absent = absent_list(keys, place.depth)) {
        put_item(*absent, keys, place.depth + 1, value);
        table->insert(keys[place.depth], std::move(*absent));
        return joined(keys, place.depth + 1);
      }
    }
    for (std::size_t depth = place.depth; depth + 1 < keys.size(); ++depth)
      table = table->insert_or_assign(keys[depth], toml::table{}).first->second.as_table();
    store(*table, keys.back(), value);
  }
  return joined(keys, place.depth + 1);
}

/// Takes away what the keys name; what follows in a list moves up.
void remove(toml::table& document, const std::vector<std::string>& keys, std::size_t number,
            Diagnostics& diagnostics) {
  const Place place = find_place(document, keys);
  if (toml::array* list = place.parent->as_array()) {
    const std::size_t index = item_index(*list, keys, place.depth);
    const std::string path = joined(keys, place.depth);
    list->erase(list->cbegin() + static_cast<std::ptrdiff_t>(index));
    diagnostics.note_removal(path, index);
    if (list->empty() || !list->front().is_table()) diagnostics.note_override(path, number);
    return;
  }
  toml::table* table = place.parent->as_table();
  if (!table->erase(keys[place.depth])) {
    std::vector<std::string> names;
    for (const auto& [name, unused] : *table) names.emplace_back(name.str());
    throw Refusal{joined(keys, place.depth + 1),
                  with_suggestion("found nothing that could be removed", keys[place.depth], names)};
  }
  diagnostics.note_override(joined(keys, keys.size()), number);
}

/// Keys that exclude each other: setting one drops the others.
void drop_alternatives(toml::table& document, const std::vector<std::string>& keys,
                       Diagnostics& diagnostics) {
  const std::size_t last = keys.size() - 1;
  const schema::Table* schema = table_at(keys, last);
  if (schema == nullptr) return;
  toml::table* table = find_place(document, keys).parent->as_table();
  for (const std::string& other : schema->alternatives_of(keys[last])) {
    table->erase(other);
    diagnostics.note_override(join_path(joined(keys, last), other), 0);
  }
}

}  // namespace

void apply_override(toml::table& document, std::string_view text, std::size_t number,
                    Diagnostics& diagnostics) {
  const std::optional<Assignment> assignment = split_override(text);
  if (!assignment) {
    diagnostics.add_override(
        number, "", fmt::format("found {}, expected KEY=VALUE with a dotted KEY", toml_quoted(text)));
    return;
  }
  if (assignment->parts.size() > most_key_parts) {
    diagnostics.add_override(
        number, "",
        fmt::format("found a key of {} parts, expected the keys of a scene", assignment->parts.size()));
    return;
  }
  try {
    const std::vector<std::string> keys = with_indices(document, assignment->parts);
    if (assignment->value == removal) return remove(document, keys, number, diagnostics);
    const std::string path = joined(keys, keys.size());
    toml::table parsed = parse_value(assignment->value, path);
    diagnostics.note_override(assign(document, keys, *parsed.get("value")), number);
    drop_alternatives(document, keys, diagnostics);
  } catch (const Refusal& refusal) {
    diagnostics.add_override(number, refusal.key, refusal.fact);
  }
}

}  // namespace vitrum::scene
