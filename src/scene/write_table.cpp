#include "scene/write_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
template <class Item>
std::string text_of(const std::vector<Item>& items) {
  std::string text;
  for (const Item& item : items) text += (text.empty() ? "" : ", ") + text_of(item);
  return '[' + text + ']';
}

/// `KEY = VALUE` for each key with a value, tables in one line among them.
std::vector<std::string> assignments(const Table& table, const void* owner) {
  std::vector<std::string> list;
  for (const Key& key : table.keys) {
    const auto value = key.get ? key.get(owner) : std::nullopt;
    if (value) list.push_back(fmt::format("{} = {}", key.name, value_text(*value)));
    if (key.table == nullptr || !key.table->in_one_line) continue;
    const void* inner = key.look(owner, 0);
    if (inner == nullptr) continue;
    list.push_back(fmt::format("{} = {{{}}}", key.name, fmt::join(assignments(*key.table, inner), ", ")));
  }
  return list;
}

void write(const Table& table, const void* owner, const std::string& path, std::string& text) {
  for (const std::string& line : assignments(table, owner)) text += line + '\n';
  for (const Key& key : table.keys) {
    if (key.table == nullptr || key.table->in_one_line) continue;
    const std::string name = join_path(path, key.name);
    const void* inner = nullptr;
    for (std::size_t n = 0; (inner = key.look(owner, n)) != nullptr; ++n) {
      const std::string full = key.table_name ? join_path(name, key.table_name(inner)) : name;
      const std::string header = '[' + full + ']';
      text += fmt::format("{}{}\n", text.empty() ? "" : "\n",
                          key.shape.kind == Kind::tables ? '[' + header + ']' : header);
      write(*key.table, inner, full, text);
    }
  }
}

}  // namespace

std::string value_text(const schema::Value& value) {
  return std::visit([](const auto& v) { return text_of(v); }, value);
}

std::string table_text(const Table& table, const void* owner) {
  std::string text;
  write(table, owner, "", text);
  return text;
}

}  // namespace vitrum::scene
