#include "scene/key_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

/// "12" rather than "12.0": bounds are read by people.
std::string limit_text(double limit) {
  return fmt::format("{:g}", limit);
}

std::string range_text(const Bounds& b) {
  const bool below = std::isfinite(b.lowest), above = std::isfinite(b.highest);
  if (below && above)
    return fmt::format(" in {}{}, {}{}", b.lowest_open ? '(' : '[', limit_text(b.lowest),
                       limit_text(b.highest), b.highest_open ? ')' : ']');
  std::string text;
  if (below) text = fmt::format(" {} {}", b.lowest_open ? ">" : ">=", limit_text(b.lowest));
  if (above) text = fmt::format(" {} {}", b.highest_open ? "<" : "<=", limit_text(b.highest));
  return text;
}

bool admits_infinity(const Bounds& b) {
  return (std::isinf(b.lowest) && !b.lowest_open) || (std::isinf(b.highest) && !b.highest_open);
}

/// Bounds that ask for nothing but a finite value.
bool is_plain(const Bounds& b) {
  return range_text(b).empty() && !admits_infinity(b);
}

/// "a number > 0 (m)", "a list of 2 numbers, inf admitted (m)"
std::string number_phrase(std::string_view noun, const Bounds& bounds, std::string_view unit) {
  std::string text = fmt::format("{}{}", noun, range_text(bounds));
  if (admits_infinity(bounds)) text += ", inf admitted";
  if (unit != "1") text += fmt::format(" ({})", unit);
  return text;
}

}  // namespace

KeyInfo number_key(std::string_view name, const Bounds& bounds, std::string_view unit,
                   std::string_view meaning) {
  const std::string_view noun = is_plain(bounds) ? "a finite number" : "a number";
  KeyInfo key = other_key(name, number_phrase(noun, bounds, unit), meaning);
  key.bounds = bounds;
  return key;
}

KeyInfo list_key(std::string_view name, std::size_t length, const Bounds& bounds, std::string_view unit,
                 std::string_view meaning) {
  const KeyInfo component = number_key(name, bounds, unit, meaning);
  const std::string_view plural = is_plain(bounds) ? "finite numbers" : "numbers";
  KeyInfo key =
      other_key(name, number_phrase(fmt::format("a list of {} {}", length, plural), bounds, unit), meaning);
  key.component = component.expected;
  key.bounds = bounds;
  return key;
}

KeyInfo numbers_key(std::string_view name, const Bounds& bounds, std::string_view unit,
                    std::string_view meaning) {
  KeyInfo key = list_key(name, 1, bounds, unit, meaning);
  const std::string_view plural = is_plain(bounds) ? "finite numbers" : "numbers";
  key.expected = number_phrase(fmt::format("a list of one or more {}", plural), bounds, unit);
  return key;
}

KeyInfo choice_key(std::string_view name, std::span<const std::string_view> choices,
                   std::string_view meaning) {
  KeyInfo key = other_key(name, "", meaning);
  key.choices.assign(choices.begin(), choices.end());
  key.expected = (choices.size() > 1 ? "one of " : "") + quoted_list(key.choices);
  return key;
}

KeyInfo text_key(std::string_view name, std::string_view meaning) {
  return other_key(name, "a string", meaning);
}

KeyInfo flag_key(std::string_view name, std::string_view meaning) {
  return other_key(name, "true or false", meaning);
}

KeyInfo other_key(std::string_view name, std::string_view expected, std::string_view meaning) {
  KeyInfo key;
  key.name = name;
  key.expected = expected;
  key.meaning = meaning;
  return key;
}

KeyInfo required(KeyInfo key) {
  key.required = true;
  return key;
}

KeyInfo defaulted(KeyInfo key, std::string_view fallback) {
  key.fallback = fallback;
  return key;
}

KeyInfo defaulted(KeyInfo key, double fallback) {
  return defaulted(std::move(key), number_text(fallback));
}

std::string quoted_list(std::span<const std::string> texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + toml_quoted(text);
  return list;
}

const KeyInfo& find_key(KeyTable keys, std::string_view name) {
  const auto found = std::ranges::find(keys, name, &KeyInfo::name);
  if (found == keys.end()) throw std::logic_error(fmt::format("no entry '{}' in the table of keys", name));
  return *found;
}

std::vector<std::string> key_names(KeyTable keys) {
  std::vector<std::string> names;
  for (const KeyInfo& key : keys) names.push_back(key.name);
  return names;
}

}  // namespace vitrum::scene
