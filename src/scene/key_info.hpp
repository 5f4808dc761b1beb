#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "materials/description.hpp"

namespace vitrum::scene {

/// One key of a table of the scene. The reader takes names, bounds, choices and the wording of its messages
/// from here, and the scene reference prints the same entries.
struct KeyInfo {
  std::string name;
  std::string expected;                       ///< phrase for a value of the right kind: "a number > 0 (m)"
  std::string component = "a finite number";  ///< the same for each number of a list
  std::string fallback;  ///< TOML text of the value used when the key is absent; empty: none
  bool required = false;
  Bounds bounds{0.0, 0.0};           ///< of numbers and of each component of a list of numbers
  std::vector<std::string> choices;  ///< admitted texts; empty: not a choice
  std::string meaning;
};
using KeyTable = std::span<const KeyInfo>;

/// Entries for a key with a number, with a list of `length` numbers, of one or more, with one of several
/// texts, with any text, with true or false, and with a value that `expected` describes.
KeyInfo number_key(std::string_view name, const Bounds& bounds, std::string_view unit,
                   std::string_view meaning);
KeyInfo list_key(std::string_view name, std::size_t length, const Bounds& bounds, std::string_view unit,
                 std::string_view meaning);
KeyInfo numbers_key(std::string_view name, const Bounds& bounds, std::string_view unit,
                    std::string_view meaning);
KeyInfo choice_key(std::string_view name, std::span<const std::string_view> choices,
                   std::string_view meaning);
KeyInfo text_key(std::string_view name, std::string_view meaning);
KeyInfo flag_key(std::string_view name, std::string_view meaning);
KeyInfo other_key(std::string_view name, std::string_view expected, std::string_view meaning);

KeyInfo required(KeyInfo key);
KeyInfo defaulted(KeyInfo key, std::string_view fallback);
KeyInfo defaulted(KeyInfo key, double fallback);

/// `"a", "b"` of texts.
std::string quoted_list(std::span<const std::string> texts);

/// The entry called `name`. Throws std::logic_error when the table has none: a fault of this program, not of
/// its input.
const KeyInfo& find_key(KeyTable keys, std::string_view name);
std::vector<std::string> key_names(KeyTable keys);

/// One entry for each number of a model's table [material.NAME.MODEL].
template <class Parameters>
std::vector<KeyInfo> parameter_keys() {
  std::vector<KeyInfo> keys;
  for (const ParameterInfo<Parameters>& info : Parameters::describe()) {
    KeyInfo key = number_key(info.name, info.bounds, info.unit, info.description);
    keys.push_back(info.fallback ? defaulted(std::move(key), *info.fallback) : required(std::move(key)));
  }
  return keys;
}

}  // namespace vitrum::scene
