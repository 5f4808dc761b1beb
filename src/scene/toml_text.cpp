#include "scene/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace vitrum::scene {
namespace {

/// A control character at the start of a UTF-8 text: its code and its bytes; none: 0 bytes. Unicode's own
/// line ends (U+0085 of the second set of control characters, U+2028, U+2029) are among them.
struct Control {
  unsigned code = 0;
  std::size_t bytes = 0;
};
Control control_at(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[i])) : 0U;
  };
  if (const unsigned first = byte(0); first < 0x20 || first == 0x7f) return {first, 1};
  if (byte(0) == 0xc2 && byte(1) >= 0x80 && byte(1) < 0xa0) return {byte(1), 2};
  if (byte(0) == 0xe2 && byte(1) == 0x80 && (byte(2) == 0xa8 || byte(2) == 0xa9))
    return {0x2000 + byte(2) - 0x80, 3};
  return {};
}

bool is_bare(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

}  // namespace

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  static_cast<void>(error);  // the longest shortest form of a double has 24 characters
  std::string text(buffer.data(), end);
  // Without a point or an exponent it would be a TOML integer, which cannot hold large values.
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string toml_quoted(std::string_view text) {
  std::string result = "\"";
  while (!text.empty()) {
    const Control control = control_at(text);
    const char c = text.front();
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else if (control.bytes > 0) {
      result += fmt::format("\\u{:04X}", control.code);
    } else {
      result += c;
    }
    text.remove_prefix(std::max<std::size_t>(control.bytes, 1));
  }
  return result + '"';
}

std::string key_text(std::string_view key) {
  return !key.empty() && std::ranges::all_of(key, is_bare) ? std::string(key) : toml_quoted(key);
}

std::string join_path(std::string_view path, std::string_view key) {
  return path.empty() ? key_text(key) : fmt::format("{}.{}", path, key_text(key));
}

std::string join_path(std::string_view path, std::size_t index) {
  return path.empty() ? std::to_string(index) : fmt::format("{}.{}", path, index);
}

bool has_control_characters(std::string_view text) {
  return single_line(text) != text;
}

std::string single_line(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t bytes = control_at(text).bytes;
    result += bytes > 0 ? ' ' : text.front();
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return result;
}

}  // namespace vitrum::scene
