#pragma once
#include <toml++/toml.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/diagnostics.hpp"
#include "scene/key_info.hpp"
#include "scene/scene.hpp"

namespace vitrum::scene {

/// What a message calls a value: `"text"`, `1.5`, `a table`, `a list of 3`.
std::string found_text(const toml::node& node);

/// Strict view of one table. Unknown keys and missing required keys are reported when it is made; each `read`
/// reports a value of the wrong type or out of bounds, returns whether a valid value was given, and else
/// leaves its target alone. Integers are taken where numbers are expected, not the other way round.
class TableReader {
 public:
  /// All arguments but `path` must outlive the reader.
  TableReader(const toml::table& table, std::string path, KeyTable keys, Diagnostics& diagnostics);

  bool has(std::string_view key) const { return table_->contains(key); }

  bool read(std::string_view key, double& value) const;
  bool read(std::string_view key, std::optional<double>& value) const;
  bool read(std::string_view key, int& value) const;
  bool read(std::string_view key, bool& value) const;
  bool read(std::string_view key, std::string& value) const;
  bool read(std::string_view key, std::optional<std::string>& value) const;
  /// A list of exactly components.size() numbers.
  bool read(std::string_view key, std::span<double> components) const;
  /// A list of any length.
  bool read(std::string_view key, std::vector<double>& values) const;
  /// A list of texts, each one of the key's choices, none twice.
  bool read(std::string_view key, std::vector<std::string>& texts) const;
  /// A list of lists of `length` numbers.
  bool read_rows(std::string_view key, std::size_t length, std::vector<std::vector<double>>& rows) const;
  /// One of the key's choices, which are listed in the order of the enumeration.
  template <class Enumeration>
  bool read_choice(std::string_view key, Enumeration& value) const {
    const std::optional<std::size_t> index = choice(key);
    if (index) value = static_cast<Enumeration>(*index);
    return index.has_value();
  }

  /// The table at `key`; nothing when absent or not a table.
  std::optional<TableReader> table(std::string_view key, KeyTable keys) const;
  /// The list of tables at `key`; those entries that are tables.
  std::vector<TableReader> tables(std::string_view key, KeyTable keys) const;

  /// Reports the value at `key`: "found <value>, expected <expected>".
  void fail(std::string_view key, std::string_view expected) const;
  /// Reports `fact` about `key` at the place of its value, or of this table when it is absent.
  void report(std::string_view key, std::string_view fact) const;
  /// The same for what is possible but implausible: a warning.
  void warn(std::string_view key, std::string_view fact) const;
  /// Reports `fact` about this table itself.
  void report(std::string_view fact) const;

  const toml::table& toml() const { return *table_; }
  const std::string& path() const { return path_; }
  Diagnostics& diagnostics() const { return *diagnostics_; }
  /// Where the value of `key` starts in the file; {0, 0} when it does not come from the file.
  toml::source_position position(std::string_view key) const;

 private:
  std::optional<std::size_t> choice(std::string_view key) const;
  std::optional<double> checked_number(const toml::node& node, const std::string& path, const Bounds& bounds,
                                       std::string_view expected) const;
  std::optional<std::vector<double>> numbers(const toml::array& list, const std::string& path,
                                             const KeyInfo& info) const;
  /// The list at `key`; null when absent or, reported, not a list.
  const toml::array* list(std::string_view key) const;
  void fail_node(const toml::node& node, const std::string& path, std::string_view expected) const;
  void check_keys() const;

  const toml::table* table_;
  std::string path_;
  KeyTable keys_;
  Diagnostics* diagnostics_;
};

}  // namespace vitrum::scene
