#include "scene/override_text.hpp"

#include <fmt/format.h>

#include "scene/key_depth.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool looks_like_text(std::string_view value) {
  return !value.empty() && value.find_first_of("\"'[]{}=\n") == std::string_view::npos &&
         value.find_first_not_of("+-.0123456789eE_") != std::string_view::npos;
}

}  // namespace

std::optional<Assignment> split_override(std::string_view text) {
  Assignment result;
  std::size_t begin = 0;
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '.' || c == '=') {
      std::string_view key = trimmed(text.substr(begin, i - begin));
      const bool in_quotes =
          key.size() >= 2 && key.front() == key.back() && (key.front() == '"' || key.front() == '\'');
      if (key.empty()) return std::nullopt;
      result.parts.push_back({std::string(in_quotes ? key.substr(1, key.size() - 2) : key), in_quotes});
      begin = i + 1;
      if (c == '=') {
        result.value = trimmed(text.substr(begin));
        return result;
      }
    }
  }
  return std::nullopt;
}

toml::table parse_value(std::string_view value, const std::string& path) {
  Refusal refusal{path, fmt::format("found {}, expected a TOML value", value.empty() ? "nothing" : value)};
  if (looks_like_text(value))
    refusal.fact += fmt::format("; quote a string: --set '{}={}'", path, toml_quoted(value));
  if (find_deep_key(value)) throw refusal;
  try {
    toml::table parsed = toml::parse(fmt::format("value = {}", value), std::string_view{});
    if (parsed.size() == 1) return parsed;  // a line break in VALUE could smuggle in further keys
  } catch (const toml::parse_error&) {
    throw refusal;
  }
  throw refusal;
}

}  // namespace vitrum::scene
