#include "scene/write_table.hpp"

#include <fmt/format.h>

#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

using schema::Key;
using schema::Kind;
using schema::Table;

std::string text_of(double value) {
  return number_text(value);
}
std::string text_of(int value) {
  return std::to_string(value);
}
std::string text_of(bool value) {
  return value ? "true" : "false";
}
std::string text_of(const std::string& value) {
  return toml_quoted(value);
}
std::string text_of(const schema::NamedNumbers& numbers) {
  std::string text;
  for (const auto& [name, value] : numbers)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key_text(name), number_text(value));
  return '{' + text + '}';
}
template <class Item>
std::string text_of(const std::vector<Item>& items) {
  std::string text;
  for (const Item& item : items) text += (text.empty() ? "" : ", ") + text_of(item);
  return '[' + text + ']';
}

std::string text_of(const schema::Function& function) {
  if (!function.formula.empty()) return toml_quoted(function.formula);
  std::string rows;
  for (const auto& [time, value] : function.table)
    rows += fmt::format("{}[{}, {}]", rows.empty() ? "" : ", ", number_text(time), number_text(value));
  return fmt::format("{{table = [{}]}}", rows);
}

/// A number or a list of numbers, with functions in place of those that vary.
std::string varying_text(const schema::Value& value, const std::string& path,
                         const schema::Functions& functions) {
  if (const auto whole = functions.find(path); whole != functions.end()) return text_of(whole->second);
  const auto* numbers = std::get_if<schema::Numbers>(&value);
  if (numbers == nullptr) return value_text(value);
  std::string text;
  for (std::size_t i = 0; i < numbers->size(); ++i) {
    const auto item = functions.find(join_path(path, i));
    text += (text.empty() ? "" : ", ") +
            (item != functions.end() ? text_of(item->second) : text_of((*numbers)[i]));
  }
  return '[' + text + ']';
}

/// The formulas at and below `path`, as a comment. They stand in the order of their values: both are that of
/// the tables' rows.
std::string comment(const std::string& path, const schema::PlacedTexts& formulas) {
  std::string text;
  for (const auto& [key, formula] : formulas)
    if (key.starts_with(path) && (key.size() == path.size() || key[path.size()] == '.'))
      text += (text.empty() ? "  # " : ", ") + single_line(formula);
  return text;
}

/// `KEY = VALUE` for each key with a value, by the key; tables in one line among them.
std::vector<std::pair<std::string, std::string>> assignments(const Table& table, const void* owner,
                                                             const std::string& place,
                                                             const schema::Functions& functions) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Key& key : table.keys) {
    const auto value = key.get ? key.get(owner) : std::nullopt;
    const std::string path = join_path(place, key.name);
    if (value)
      list.emplace_back(key.name,
                        fmt::format("{} = {}", key.name,
                                    key.over_time || key.over_place ? varying_text(*value, path, functions)
                                                                    : value_text(*value)));
    if (key.table == nullptr || !key.table->in_one_line) continue;
    const bool many = key.shape.kind == Kind::tables;
    std::string texts;
    const void* inner = nullptr;
    for (std::size_t n = 0; (n == 0 || many) && (inner = key.look(owner, n)) != nullptr; ++n) {
      std::string text;
      for (const auto& [name, line] :
           assignments(*key.table, inner, many ? join_path(path, n) : path, functions))
        text += (text.empty() ? "" : ", ") + line;
      texts += fmt::format("{}{{{}}}", n > 0 ? ", " : "", text);
    }
    if (!texts.empty())
      list.emplace_back(key.name, fmt::format("{} = {}", key.name, many ? '[' + texts + ']' : texts));
  }
  return list;
}

/// Writes a document part by part.
class Writer {
 public:
  Writer(const schema::PlacedTexts& formulas, const schema::Functions& functions)
      : formulas_(formulas), functions_(functions) {}

  /// The keys of a table that stands at `place`; in headers its name is `path`, without the indices of lists.
  void write(const Table& table, const void* owner, const std::string& path, const std::string& place) {
    for (const auto& [name, line] : assignments(table, owner, place, functions_))
      text_ += line + comment(join_path(place, name), formulas_) + '\n';
    for (const Key& key : table.keys)
      if (key.table != nullptr && !key.table->in_one_line)
        write_tables(key, owner, join_path(path, key.name), join_path(place, key.name));
  }

  std::string take() { return std::move(text_); }

 private:
  void write_tables(const Key& key, const void* owner, const std::string& path, const std::string& place) {
    const void* inner = nullptr;
    for (std::size_t n = 0; (inner = key.look(owner, n)) != nullptr; ++n) {
      const bool in_list = key.shape.kind == Kind::tables;
      const std::string name = key.table_name ? join_path(path, key.table_name(inner)) : path;
      text_ += fmt::format("{0}{1}[{2}]{3}\n", text_.empty() ? "" : "\n", in_list ? "[" : "", name,
                           in_list ? "]" : "");
      write(*key.table, inner, name,
            in_list          ? join_path(place, n)
            : key.table_name ? join_path(place, key.table_name(inner))
                             : place);
    }
  }

  const schema::PlacedTexts& formulas_;
  const schema::Functions& functions_;
  std::string text_;
};

}  // namespace

std::string value_text(const schema::Value& value) {
  return std::visit([](const auto& v) { return text_of(v); }, value);
}

std::string table_text(const Table& table, const void* owner, const schema::PlacedTexts& formulas,
                       const schema::Functions& functions) {
  Writer writer(formulas, functions);
  writer.write(table, owner, "", "");
  return writer.take();
}

}  // namespace vitrum::scene
