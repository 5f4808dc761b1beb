#include "scene/read_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/csv_rows.hpp"
#include "scene/suggestion.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

using schema::Key;
using schema::Kind;
using schema::Numbers;
using schema::Value;

/// Reads the value of one key. Whatever returns nothing has reported why.
class ValueReader {
 public:
  ValueReader(const TableView& table, const Key& key)
      : table_(table), key_(key), path_(join_path(table.path(), key.name)) {}

  std::optional<Value> read(const toml::node& node) const {
    switch (key_.shape.kind) {
      case Kind::number:
        return number(node, path_, expected(key_));
      case Kind::integer:
        return integer(node);
      case Kind::named_numbers:
        return named_numbers(node);
      case Kind::flag:
        return node.is_boolean() ? std::optional<Value>(node.as_boolean()->get()) : wrong();
      case Kind::text:
        return text(node, path_, expected(key_));
      case Kind::numbers:
        return has_length(node, key_.shape.length) ? numbers(*node.as_array(), path_) : wrong();
      case Kind::rows:
        if (node.is_table() && key_.shape.length == 0 && key_.shape.width == 2)
          return rows_of_file(*node.as_table());
        return has_length(node, key_.shape.length) ? rows(*node.as_array(), key_.shape.width, path_)
                                                   : wrong();
      case Kind::texts:
        return has_length(node, key_.shape.length) ? texts(*node.as_array()) : wrong();
      default:
        return wrong();
    }
  }

 private:
  std::nullopt_t wrong() const {
    table_.fail(key_.name, expected(key_));
    return std::nullopt;
  }
  std::nullopt_t wrong(const toml::node& node, const std::string& path, std::string_view what) const {
    table_.fail_node(node, path, what);
    return std::nullopt;
  }

  /// Whether a node is a list of so many items; 0: of one or more numbers or rows, or of any texts.
  bool has_length(const toml::node& node, std::size_t length) const {
    if (!node.is_array()) return false;
    const std::size_t found = node.as_array()->size();
    if (length > 0 || key_.shape.kind == Kind::texts) return length == 0 || found == length;
    return found >= (key_.shape.kind == Kind::rows ? key_.fewest : 1);
  }

  std::optional<Value> number(const toml::node& node, const std::string& path, std::string_view what) const {
    if (node.is_string() && is_formula(node.as_string()->get())) return formula(node, path, what);
    if (node.is_table() && key_.over_time) return time_table(*node.as_table(), path);
    if (node.is_string()) return wrong(node, path, fmt::format("{}; a formula begins with '='", what));
    if (!node.is_number()) return wrong(node, path, what);
    const double found =
        node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
    return key_.bounds.contain(found) ? std::optional<Value>(found) : wrong(node, path, what);
  }

  std::optional<Value> formula(const toml::node& node, const std::string& path, std::string_view what) const {
    const std::string& text = node.as_string()->get();
    if (key_.over_time || key_.over_place) {
      bool varies = false;
      const std::string fault = table_.formulas().fault(text, key_.over_time, key_.over_place, varies);
      if (!fault.empty()) return wrong(node, path, fmt::format("a formula: {}", fault));
      if (varies) {
        table_.formulas().note(path, schema::Function{text});
        return 0.0;
      }
    }
    const std::variant<double, std::string> result = table_.formulas().value(text);
    if (const auto* fault = std::get_if<std::string>(&result))
      return wrong(node, path, fmt::format("a formula: {}", *fault));
    const double found = std::get<double>(result);
    if (!key_.bounds.contain(found))
      return wrong(node, path, fmt::format("{}; the formula gives {}", what, number_text(found)));
    table_.formulas().note(path, text);
    return found;
  }

  /// {table = [[t, value], ..]} or {csv = "FILE"}.
  std::optional<Value> time_table(const toml::table& node, const std::string& path) const {
    constexpr std::string_view forms = R"(a number, a formula, {table = [[t, value], ..]} or {csv = "FILE"})";
    const toml::node *list = node.get("table"), *file = node.get("csv");
    if (node.size() != 1 || (list == nullptr && (file == nullptr || !file->is_string())))
      return wrong(node, path, forms);
    const std::string name = join_path(path, list != nullptr ? "table" : "csv");
    const auto rows = list != nullptr ? rows_in_scene(*list, name)
                                      : rows_in_file(*file, name, "a CSV file of rows t,value");
    if (!rows) return std::nullopt;
    if (rows->size() < 2)
      return wrong(list != nullptr ? *list : *file, name, "two or more rows [t, value] by rising time");
    schema::Function function;
    for (const Row& row : *rows) {
      if (!key_.bounds.contain(row.values[1]))
        return wrong(row, number_text(row.values[1]), expected_component(key_) + " in each row");
      if (const auto& before = function.table; !before.empty() && !(row.values[0] > before.back()[0]))
        return wrong(
            row, fmt::format("{} s after {} s", number_text(row.values[0]), number_text(before.back()[0])),
            "rows [t, value] by rising time");
      function.table.push_back(row.values);
    }
    if (list == nullptr) table_.formulas().note(path, file->as_string()->get());
    table_.formulas().note(path, std::move(function));
    return 0.0;
  }

  /// A row of two numbers, and where it stands: `in` is the line of a file that the node names, or nothing.
  struct Row {
    const toml::node& node;
    std::string path, in;
    std::array<double, 2> values;
  };
  std::nullopt_t wrong(const Row& row, std::string_view found, std::string_view what) const {
    table_.diagnostics().add(row.path, row.node.source().begin, row.path,
                             fmt::format("found {}{}, expected {}", found, row.in, what));
    return std::nullopt;
  }

  std::optional<std::vector<Row>> rows_in_scene(const toml::node& list, const std::string& path) const {
    if (!list.is_array()) return wrong(list, path, "rows [t, value]");
    Key constants = key_;
    constants.over_time = constants.over_place = false, constants.bounds = intervals::finite;
    const std::optional<Value> read = ValueReader(table_, constants).rows(*list.as_array(), 2, path);
    if (!read) return std::nullopt;
    std::vector<Row> rows;
    for (const Numbers& row : std::get<std::vector<Numbers>>(*read))
      rows.push_back({list.as_array()->at(rows.size()), join_path(path, rows.size()), "", {row[0], row[1]}});
    return rows;
  }

  std::optional<std::vector<Row>> rows_in_file(const toml::node& file, const std::string& path,
                                               std::string_view what) const {
    const std::string& name = file.as_string()->get();
    const auto found = read_csv_rows(table_.formulas().folder(), name);
    if (const auto* fault = std::get_if<std::string>(&found))
      return wrong(file, path, fmt::format("{}: {}", what, *fault));
    std::vector<Row> rows;
    for (const CsvRow& row : std::get<0>(found))
      rows.push_back({file, path, fmt::format(" ({}:{})", name, row.line), row.values});
    return rows;
  }

  /// {csv = "FILE"} in place of rows of two numbers.
  std::optional<Value> rows_of_file(const toml::table& node) const {
    constexpr std::string_view what = "a CSV file of rows of two numbers";
    const toml::node* file = node.get("csv");
    if (node.size() != 1 || file == nullptr || !file->is_string()) return wrong();
    const auto found = rows_in_file(*file, join_path(path_, "csv"), what);
    if (!found) return std::nullopt;
    std::vector<Numbers> rows;
    for (const Row& row : *found) rows.push_back({row.values.begin(), row.values.end()});
    table_.formulas().note(path_, file->as_string()->get());
    return rows.empty() ? std::optional<Value>(wrong(*file, join_path(path_, "csv"), what)) : rows;
  }

  std::optional<Value> named_numbers(const toml::node& node) const {
    if (!node.is_table()) return wrong();
    schema::NamedNumbers numbers;
    const std::vector<std::string> names = names_in_order(*node.as_table());
    table_.formulas().announce(names);
    for (const std::string& name : names) {
      const toml::node& item = *node.as_table()->get(name);
      const std::string path = join_path(path_, name);
      const std::optional<Value> value = number(item, path, expected_component(key_));
      if (!value) continue;
      const std::string fault = table_.formulas().define(name, std::get<double>(*value));
      if (!fault.empty())
        table_.diagnostics().add(path, item.source().begin, path, "found a parameter of this name, " + fault);
      numbers.emplace_back(name, std::get<double>(*value));
    }
    return numbers;
  }

  std::optional<Value> integer_formula(const toml::node& node) const {
    const std::optional<Value> value = formula(node, path_, expected(key_));
    if (!value) return value;
    const double found = std::get<double>(*value);
    return admits(found) ? std::optional<Value>(static_cast<int>(found)) : wrong();
  }

  /// Whether a number is an integer that the key takes.
  bool admits(double number) const {
    using Limits = std::numeric_limits<int>;
    if (number != std::floor(number) || number < Limits::min() || number > Limits::max()) return false;
    if (!key_.bounds.contain(number)) return false;
    return key_.admitted.empty() ||
           std::ranges::find(key_.admitted, static_cast<int>(number)) != key_.admitted.end();
  }

  std::optional<Value> integer(const toml::node& node) const {
    if (node.is_string() && is_formula(node.as_string()->get())) return integer_formula(node);
    if (!node.is_integer()) return wrong();
    const std::int64_t found = node.as_integer()->get();
    return admits(static_cast<double>(found)) ? std::optional<Value>(static_cast<int>(found)) : wrong();
  }

  std::optional<Value> text(const toml::node& node, const std::string& path, const std::string& what) const {
    if (!node.is_string()) return wrong(node, path, what);
    const std::string& found = node.as_string()->get();
    const std::vector<std::string>& choices = key_.choices;
    if (choices.empty() || std::ranges::find(choices, found) != choices.end()) return found;
    return wrong(node, path, with_suggestion(what, found, choices));
  }

  /// The items of a list, each read by `item(node, path)`.
  template <class Item, class Read>
  std::optional<Value> items(const toml::array& list, const std::string& path, Read&& item) const {
    std::vector<Item> values;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (std::optional<Value> value = item(list[i], join_path(path, i)))
        values.push_back(std::get<Item>(*std::move(value)));
    return values.size() == list.size() ? std::optional<Value>(std::move(values)) : std::nullopt;
  }

  std::optional<Value> numbers(const toml::array& list, const std::string& path) const {
    return items<double>(list, path, [&](const toml::node& node, const std::string& at) {
      return number(node, at, expected_component(key_));
    });
  }

  std::optional<Value> rows(const toml::array& list, std::size_t width, const std::string& path) const {
    return items<Numbers>(list, path, [&](const toml::node& node, const std::string& at) {
      return node.is_array() && node.as_array()->size() == width
                 ? numbers(*node.as_array(), at)
                 : wrong(node, at, fmt::format("a list of {} numbers", width));
    });
  }

  std::optional<Value> texts(const toml::array& list) const {
    const std::string what =
        key_.choices.empty() ? "a string" : "one of " + schema::quoted_list(key_.choices);
    std::vector<std::string> earlier;
    return items<std::string>(list, path_, [&](const toml::node& node, const std::string& at) {
      std::optional<Value> found = text(node, at, what);
      if (!found) return found;
      const std::string& value = std::get<std::string>(*found);
      if (std::ranges::find(earlier, value) != earlier.end())
        return std::optional<Value>(wrong(node, at, "every entry once"));
      earlier.push_back(value);
      return found;
    });
  }

  const TableView& table_;
  const Key& key_;
  std::string path_;
};

}  // namespace

std::optional<Value> read_value(const TableView& table, const Key& key, const toml::node& node) {
  return ValueReader(table, key).read(node);
}

}  // namespace vitrum::scene
