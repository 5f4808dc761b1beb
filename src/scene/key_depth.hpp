#pragma once
#include <cstddef>
#include <optional>
#include <string_view>

namespace vitrum::scene {

/// Parts that a dotted key may have. toml++ bounds how deep values are nested, but not keys, and tables
/// within tables within tables overflow the stack of whoever walks through them.
inline constexpr std::size_t most_key_parts = 64;

/// A place in a text, counted from 1.
struct TextPlace {
  unsigned line, column;
};

/// Where a TOML text has a key of more parts; nothing when it has none.
std::optional<TextPlace> find_deep_key(std::string_view text);

}  // namespace vitrum::scene
