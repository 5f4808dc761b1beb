#pragma once
#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vitrum::scene {

/// A fault of the argument: what was found and expected at `key`.
struct Refusal {
  std::string key, fact;
};

/// One part of a dotted key.
struct KeyPart {
  std::string text;
  bool in_quotes;  ///< then it is a name, even of digits
};

struct Assignment {
  std::vector<KeyPart> parts;
  std::string_view value;
};

/// Splits `a."b.c".0=VALUE` at the first '=' and the dots outside quotes; nothing when a part is missing.
std::optional<Assignment> split_override(std::string_view text);

/// The document `value = VALUE`, so that toml++ reads VALUE by its own rules. path: of the key, for the
/// Refusal that is thrown where it does not.
toml::table parse_value(std::string_view value, const std::string& path);

}  // namespace vitrum::scene
