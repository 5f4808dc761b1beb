#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/bounds.hpp"
#include "schema/value.hpp"

namespace vitrum::schema {

struct Table;

/// One key of a table, without the type of the struct that it belongs to (field.hpp makes it from a member of
/// that). What reads and writes files, and prints the pages about them, knows no more of a key than this.
struct Key {
  std::string name;
  Shape shape{};
  std::string unit = "1";
  Bounds bounds = intervals::infinite_too;     ///< of a number, and of each number of a list
  std::vector<std::string> choices;            ///< admitted texts; none: any
  std::vector<std::string> choices_elsewhere;  ///< what other scenes admit: of the other geometry
  std::vector<int> admitted;                   ///< integers; none: all within bounds
  std::size_t fewest = 1;                      ///< rows
  bool over_time = false, over_place = false;  ///< functions may stand in place of its numbers
  bool required = false;
  std::optional<Value> fallback;  ///< in effect when neither the key nor an alternative of it is given
  std::string phrase;             ///< what is expected, where it is not what expected() would say
  std::string text;               ///< meaning
  const Table* table = nullptr;   ///< what a table, or each of its tables, may hold

  /// The value in a struct; nothing: absent.
  std::function<std::optional<Value>(const void* owner)> get;
  std::function<void(void* owner, const Value&)> set;
  /// The struct that a table is read into, made where there is none; of lists, a new one at the end. `name`:
  /// of a named table.
  std::function<void*(void* owner, const std::string& name)> open;
  /// The struct that table number n stands for; null: there is none.
  std::function<const void*(const void* owner, std::size_t n)> look;
  /// The name of a named table.
  std::function<const std::string&(const void* table)> table_name;
};

/// Keys that exclude each other.
struct Alternatives {
  std::vector<std::string> keys;
  std::string needed;  ///< what exactly one of them must give ("shape"); empty: at most one is given

  bool hold(std::string_view key) const;
};

/// What may stand in a table.
struct Table {
  std::string heading;  ///< of its part of the reference: "[space]", "`perturbation` of a body"
  std::string text;
  std::vector<Key> keys;
  bool in_one_line = false;  ///< how it is written: {centre = [..], radius = ..}
  std::vector<Alternatives> alternatives{};
  /// A key whose presence gives all others, also in the tables below, that the file does not: a preset.
  std::string filled_by{};

  const Key* find(std::string_view name) const;
  std::vector<std::string> names() const;
  /// The keys that `name` excludes.
  std::vector<std::string> alternatives_of(std::string_view name) const;
};

/// What a message expects at a key: "a number > 0 (m)", "one of "usf", "usl"".
std::string expected(const Key& key);
/// The same of each number of a list.
std::string expected_component(const Key& key);

/// `"a", "b"` of texts.
std::string quoted_list(const std::vector<std::string>& texts);

/// Calls `visit` for a table and all below it, each once, in the order of the reference.
void visit_tables(const Table& table, const std::function<void(const Table&)>& visit);

}  // namespace vitrum::schema
