#include "scene/overrides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <vector>

#include "scene/key_depth.hpp"
#include "scene/scene_tables.hpp"
#include "scene/suggestion.hpp"
#include "scene/table_view.hpp"
#include "scene/toml_text.hpp"
#include "scene/write_table.hpp"

namespace vitrum::scene {
namespace {

/// In place of a value: takes the key away. No TOML value, so that none can be meant instead.
constexpr std::string_view removal = "none";

/// A fault of the argument: what was found and expected at `key`.
struct Refusal {
  std::string key, fact;
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string joined(const std::vector<std::string>& keys, std::size_t count) {
  std::string path;
  for (std::size_t i = 0; i < count; ++i) path = join_path(path, keys[i]);
  return path;
}

/// One part of a dotted key.
struct KeyPart {
  std::string text;
  bool in_quotes;  ///< then it is a name, even of digits
};

struct Assignment {
  std::vector<KeyPart> parts;
  std::string_view value;
};

/// Splits `a."b.c".0=VALUE` at the first '=' and the dots outside quotes; nothing when a part is missing.
std::optional<Assignment> split(std::string_view text) {
  Assignment result;
  std::size_t begin = 0;
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '.' || c == '=') {
      std::string_view key = trimmed(text.substr(begin, i - begin));
      const bool in_quotes =
          key.size() >= 2 && key.front() == key.back() && (key.front() == '"' || key.front() == '\'');
      if (key.empty()) return std::nullopt;
      result.parts.push_back({std::string(in_quotes ? key.substr(1, key.size() - 2) : key), in_quotes});
      begin = i + 1;
      if (c == '=') {
        result.value = trimmed(text.substr(begin));
        return result;
      }
    }
  }
  return std::nullopt;
}

bool looks_like_text(std::string_view value) {
  return !value.empty() && value.find_first_of("\"'[]{}=\n") == std::string_view::npos &&
         value.find_first_not_of("+-.0123456789eE_") != std::string_view::npos;
}

/// The document `value = VALUE`, so that toml++ reads VALUE by its own rules.
toml::table parse_value(const Assignment& assignment, const std::string& path) {
  Refusal refusal{path, fmt::format("found {}, expected a TOML value",
                                    assignment.value.empty() ? "nothing" : assignment.value)};
  if (looks_like_text(assignment.value))
    refusal.fact += fmt::format("; quote a string: --set '{}={}'", path, toml_quoted(assignment.value));
  if (find_deep_key(assignment.value)) throw refusal;
  try {
    toml::table parsed = toml::parse(fmt::format("value = {}", assignment.value), std::string_view{});
    if (parsed.size() == 1) return parsed;  // a line break in VALUE could smuggle in further keys
  } catch (const toml::parse_error&) {
    throw refusal;
  }
  throw refusal;
}

bool to_index(const std::string& key, std::size_t& index) {
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  return error == std::errc{} && end == key.data() + key.size();
}

/// The item of `list` that `keys[depth]` names.
std::size_t item_index(const toml::array& list, const std::vector<std::string>& keys, std::size_t depth) {
  const std::string& key = keys[depth];
  std::size_t index = 0;
  if (to_index(key, index) && index < list.size()) return index;
  const std::string range =
      list.empty() ? "the list is empty" : fmt::format("expected an index from 0 to {}", list.size() - 1);
  throw Refusal{joined(keys, depth + 1),
                fmt::format("found index {} of a list of length {}, {}", key, list.size(), range)};
}

bool is_index(std::string_view key) {
  return std::ranges::all_of(key, [](char c) { return c >= '0' && c <= '9'; });
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

/// The keys with indices in place of names, as far as the document goes.
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
  const std::optional<Assignment> assignment = split(text);
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
    toml::table parsed = parse_value(*assignment, path);
    diagnostics.note_override(assign(document, keys, *parsed.get("value")), number);
    drop_alternatives(document, keys, diagnostics);
  } catch (const Refusal& refusal) {
    diagnostics.add_override(number, refusal.key, refusal.fact);
  }
}

}  // namespace vitrum::scene
