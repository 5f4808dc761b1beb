#include "schema/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace vitrum::schema {
namespace {

/// "12" rather than "12.0": bounds are read by people.
std::string range_text(const Bounds& b) {
  const bool below = std::isfinite(b.lowest), above = std::isfinite(b.highest);
  if (below && above)
    return fmt::format(" in {}{:g}, {:g}{}", b.lowest_open ? '(' : '[', b.lowest, b.highest,
                       b.highest_open ? ')' : ']');
  if (below) return fmt::format(" {} {:g}", b.lowest_open ? ">" : ">=", b.lowest);
  return above ? fmt::format(" {} {:g}", b.highest_open ? "<" : "<=", b.highest) : "";
}

bool admits_infinity(const Bounds& b) {
  return (std::isinf(b.lowest) && !b.lowest_open) || (std::isinf(b.highest) && !b.highest_open);
}

/// "a number > 0 (m)", "a list of 2 numbers, inf admitted (m)": `article`, then "number" or "numbers".
std::string numbers_text(std::string_view article, std::string_view noun, const Key& key) {
  const std::string range = range_text(key.bounds);
  const bool infinite = admits_infinity(key.bounds);
  const char* varies = key.over_time && key.over_place ? " or functions of time and place"
                       : key.over_time                 ? " or functions of time"
                       : key.over_place                ? " or formulas of place"
                                                       : "";
  return fmt::format("{} {}{}{}{}{}{}", article, range.empty() && !infinite ? "finite " : "", noun, range,
                     infinite ? ", inf admitted" : "", varies,
                     key.unit == "1" ? "" : fmt::format(" ({})", key.unit));
}

std::string integer_text(const Key& key) {
  if (key.admitted.empty())
    return fmt::format("an integer from {:.0f} to {:.0f}", key.bounds.lowest, key.bounds.highest);
  const std::vector<int> but_last(key.admitted.begin(), key.admitted.end() - 1);
  return fmt::format("{} or {}", fmt::join(but_last, ", "), key.admitted.back());
}

std::string text_text(const Key& key) {
  if (key.choices.empty()) return "a string";
  return (key.choices.size() > 1 ? "one of " : "") + quoted_list(key.choices);
}

std::string texts_text(const Key& key) {
  if (!key.choices.empty()) return "a list of " + quoted_list(key.choices);
  return key.shape.length > 0 ? fmt::format("a list of {} strings", key.shape.length) : "a list of strings";
}

/// "a table {centre = [..], radius = ..}", "a table [space]".
std::string table_text(const Table& table) {
  if (!table.in_one_line) return "a table " + table.heading;
  std::string keys;
  for (const Key& key : table.keys)
    keys += fmt::format("{}{} = {}", keys.empty() ? "" : ", ", key.name,
                        key.shape.kind == Kind::numbers ? "[..]" : "..");
  return fmt::format("a table {{{}}}", keys);
}

void visit_once(const Table& table, std::set<const Table*>& seen,
                const std::function<void(const Table&)>& visit) {
  if (!seen.insert(&table).second) return;
  visit(table);
  for (const Key& key : table.keys)
    if (key.table != nullptr) visit_once(*key.table, seen, visit);
}

}  // namespace

bool Alternatives::hold(std::string_view key) const {
  return std::ranges::find(keys, key) != keys.end();
}

const Key* Table::find(std::string_view name) const {
  const auto found = std::ranges::find(keys, name, &Key::name);
  return found != keys.end() ? &*found : nullptr;
}

std::vector<std::string> Table::names() const {
  std::vector<std::string> list;
  for (const Key& key : keys) list.push_back(key.name);
  return list;
}

std::vector<std::string> Table::alternatives_of(std::string_view name) const {
  std::vector<std::string> list;
  for (const Alternatives& group : alternatives)
    if (group.hold(name))
      std::ranges::copy_if(group.keys, std::back_inserter(list),
                           [&](const std::string& other) { return other != name; });
  return list;
}

std::string quoted_list(const std::vector<std::string>& texts) {
  return texts.empty() ? "" : fmt::format("\"{}\"", fmt::join(texts, "\", \""));
}

std::string expected_component(const Key& key) {
  return numbers_text("a", "number", key);
}

std::string expected(const Key& key) {
  if (!key.phrase.empty()) return key.phrase;
  const auto [kind, length, width] = key.shape;
  switch (kind) {
    case Kind::number:
      return expected_component(key);
    case Kind::integer:
      return integer_text(key);
    case Kind::flag:
      return "true or false";
    case Kind::text:
      return text_text(key);
    case Kind::numbers:
      return numbers_text(length > 0 ? fmt::format("a list of {}", length) : "a list of one or more",
                          "numbers", key);
    case Kind::rows:
      return numbers_text(length > 0 ? fmt::format("{} rows of {}", length, width)
                                     : fmt::format("a list of one or more rows of {}", width),
                          "numbers", key);
    case Kind::texts:
      return texts_text(key);
    case Kind::named_numbers:
      return fmt::format("a table [{}] of {}", key.name, numbers_text("", "numbers", key).substr(1));
    case Kind::table:
      return table_text(*key.table);
    case Kind::tables:
      return fmt::format("tables {}{}", key.table->heading, key.required ? ", at least one" : "");
    case Kind::named_tables:
      return fmt::format("a table {} for each {}", key.table->heading, key.name);
  }
  return {};
}

void visit_tables(const Table& table, const std::function<void(const Table&)>& visit) {
  std::set<const Table*> seen;
  visit_once(table, seen, visit);
}

}  // namespace vitrum::schema
