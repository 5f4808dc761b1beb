#pragma once
#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/diagnostics.hpp"
#include "scene/formulas.hpp"
#include "schema/table.hpp"

namespace vitrum::scene {

/// What a message calls a value: `"text"`, `1.5`, `a table`, `a list of 3`.
std::string found_text(const toml::node& node);

/// One table of a document, what may stand in it, and where its faults go.
class TableView {
 public:
  /// All arguments but `path` must outlive the view.
  TableView(const toml::table& table, std::string path, const schema::Table& schema, Diagnostics& diagnostics,
            Formulas& formulas)
      : table_(&table),
        path_(std::move(path)),
        schema_(&schema),
        diagnostics_(&diagnostics),
        formulas_(&formulas) {}

  bool has(std::string_view key) const { return table_->contains(key); }
  /// Whether nothing has been reported of the key, or below it: what was read from it, or its default, holds.
  bool sound(std::string_view key) const;
  /// What the key's row expects.
  std::string expected(std::string_view key) const { return schema::expected(*schema_->find(key)); }

  /// Reports the value at `key`: "found <value>, expected <expected>".
  void fail(std::string_view key, std::string_view expected) const;
  /// Reports `fact` about `key` at the place of its value, or of this table when it is absent.
  void report(std::string_view key, std::string_view fact) const;
  /// The same for what is possible but implausible: a warning.
  void warn(std::string_view key, std::string_view fact) const;
  /// Reports `fact` about this table itself.
  void report(std::string_view fact) const;
  /// Reports what was found at `path`, a key or an item of this table.
  void fail_node(const toml::node& node, const std::string& path, std::string_view expected) const;

  /// The table at `key`; nothing when absent or not a table.
  std::optional<TableView> table(std::string_view key) const;
  /// The tables at `key`, of a list or, in the order of the file, of a table of tables.
  std::vector<TableView> tables(std::string_view key) const;

  const toml::table& toml() const { return *table_; }
  const schema::Table& schema() const { return *schema_; }
  const std::string& path() const { return path_; }
  Diagnostics& diagnostics() const { return *diagnostics_; }
  Formulas& formulas() const { return *formulas_; }
  /// Where the value of `key` starts in the file; {0, 0} when it does not come from the file.
  toml::source_position position(std::string_view key) const;

 private:
  /// Where a message about `key` belongs: at its value or, absent, at this table.
  const toml::node& place_of(std::string_view key) const;

  const toml::table* table_;
  std::string path_;
  const schema::Table* schema_;
  Diagnostics* diagnostics_;
  Formulas* formulas_;
};

/// The names in a table of tables in the order of the file; those that only --set gives come last.
std::vector<std::string> names_in_order(const toml::table& tables);

}  // namespace vitrum::scene
