#include "scene/toml_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "scene/suggestion.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

constexpr std::size_t longest_quoted_text = 60;

std::optional<double> number_of(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
  if (const auto* real = node.as_floating_point()) return real->get();
  return std::nullopt;
}

}  // namespace

std::string found_text(const toml::node& node) {
  if (const auto* text = node.as_string()) {
    const std::string& value = text->get();
    return value.size() <= longest_quoted_text ? toml_quoted(value)
                                               : fmt::format("a string of {} bytes", value.size());
  }
  if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
  if (const auto* real = node.as_floating_point()) return number_text(real->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (const auto* list = node.as_array())
    return list->empty() ? "an empty list" : fmt::format("a list of {}", list->size());
  return node.is_table() ? "a table" : "a date or time";
}

TableReader::TableReader(const toml::table& table, std::string path, KeyTable keys, Diagnostics& diagnostics)
    : table_(&table), path_(std::move(path)), keys_(keys), diagnostics_(&diagnostics) {
  check_keys();
}

void TableReader::check_keys() const {
  const std::vector<std::string> names = key_names(keys_);
  for (const auto& [key, node] : *table_) {
    if (std::ranges::find(names, key.str()) != names.end()) continue;
    const std::string path = join_path(path_, key.str());
    const std::string fact = fmt::format("found an unknown key, expected {}{}",
                                         names.size() > 1 ? "one of " : "", fmt::join(names, ", "));
    diagnostics_->add(path, key.source().begin, path, with_suggestion(fact, key.str(), names));
  }
  for (const KeyInfo& info : keys_)
    if (info.required && !has(info.name))
      report(info.name, fmt::format("found nothing, expected {}", info.expected));
}

toml::source_position TableReader::position(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node != nullptr ? node->source().begin : toml::source_position{};
}

void TableReader::fail_node(const toml::node& node, const std::string& path,
                            std::string_view expected) const {
  diagnostics_->add(path, node.source().begin, path,
                    fmt::format("found {}, expected {}", found_text(node), expected));
}

void TableReader::fail(std::string_view key, std::string_view expected) const {
  const toml::node* node = table_->get(key);
  report(key,
         fmt::format("found {}, expected {}", node != nullptr ? found_text(*node) : "nothing", expected));
}

void TableReader::report(std::string_view key, std::string_view fact) const {
  const std::string path = join_path(path_, key);
  const toml::node* node = table_->get(key);
  if (node != nullptr)
    diagnostics_->add(path, node->source().begin, path, fact);
  else
    diagnostics_->add(path, table_->source().begin, path, fact);
}

void TableReader::warn(std::string_view key, std::string_view fact) const {
  const std::string path = join_path(path_, key);
  const toml::node* node = table_->get(key);
  diagnostics_->warn(node != nullptr ? path : path_, (node != nullptr ? *node : *table_).source().begin, path,
                     fact);
}

void TableReader::report(std::string_view fact) const {
  diagnostics_->add(path_, table_->source().begin, path_, fact);
}

std::optional<double> TableReader::checked_number(const toml::node& node, const std::string& path,
                                                  const Bounds& bounds, std::string_view expected) const {
  const std::optional<double> number = number_of(node);
  if (number && bounds.contain(*number)) return number;
  fail_node(node, path, expected);
  return std::nullopt;
}

bool TableReader::read(std::string_view key, double& value) const {
  const KeyInfo& info = find_key(keys_, key);
  const toml::node* node = table_->get(key);
  if (node == nullptr) return false;
  const std::optional<double> number =
      checked_number(*node, join_path(path_, key), info.bounds, info.expected);
  if (number) value = *number;
  return number.has_value();
}

bool TableReader::read(std::string_view key, std::optional<double>& value) const {
  double number = 0.0;
  if (!read(key, number)) return false;
  value = number;
  return true;
}

bool TableReader::read(std::string_view key, int& value) const {
  const KeyInfo& info = find_key(keys_, key);
  const toml::node* node = table_->get(key);
  if (node == nullptr) return false;
  const auto* integer = node->as_integer();
  const bool valid = integer != nullptr && integer->get() >= std::numeric_limits<int>::min() &&
                     integer->get() <= std::numeric_limits<int>::max() &&
                     info.bounds.contain(static_cast<double>(integer->get()));
  if (!valid) fail(key, info.expected);
  if (valid) value = static_cast<int>(integer->get());
  return valid;
}

bool TableReader::read(std::string_view key, bool& value) const {
  const KeyInfo& info = find_key(keys_, key);
  const toml::node* node = table_->get(key);
  if (node == nullptr) return false;
  const auto* flag = node->as_boolean();
  if (flag == nullptr) fail(key, info.expected);
  if (flag != nullptr) value = flag->get();
  return flag != nullptr;
}

bool TableReader::read(std::string_view key, std::string& value) const {
  const KeyInfo& info = find_key(keys_, key);
  const toml::node* node = table_->get(key);
  if (node == nullptr) return false;
  const auto* text = node->as_string();
  if (text == nullptr) {
    fail(key, info.expected);
    return false;
  }
  value = text->get();
  return true;
}

bool TableReader::read(std::string_view key, std::optional<std::string>& value) const {
  std::string text;
  if (!read(key, text)) return false;
  value = std::move(text);
  return true;
}

std::optional<std::size_t> TableReader::choice(std::string_view key) const {
  const KeyInfo& info = find_key(keys_, key);
  const toml::node* node = table_->get(key);
  if (node == nullptr) return std::nullopt;
  const auto* text = node->as_string();
  const auto found = text != nullptr ? std::ranges::find(info.choices, text->get()) : info.choices.end();
  if (found != info.choices.end()) return static_cast<std::size_t>(found - info.choices.begin());
  fail(key, text != nullptr ? with_suggestion(info.expected, text->get(), info.choices) : info.expected);
  return std::nullopt;
}

std::optional<TableReader> TableReader::table(std::string_view key, KeyTable keys) const {
  const KeyInfo& info = find_key(keys_, key);
  const toml::node* node = table_->get(key);
  if (node == nullptr) return std::nullopt;
  if (const toml::table* child = node->as_table())
    return TableReader(*child, join_path(path_, key), keys, *diagnostics_);
  fail(key, info.expected);
  return std::nullopt;
}

}  // namespace vitrum::scene
