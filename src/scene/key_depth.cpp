#include "scene/key_depth.hpp"

#include <algorithm>

namespace vitrum::scene {
namespace {

/// End of the string that starts at `text`: just behind its closing quotes.
std::size_t string_length(std::string_view text) {
  const char quote = text[0];
  const bool is_long = text.size() >= 3 && text[1] == quote && text[2] == quote;
  const std::string_view closing = text.substr(0, is_long ? 3 : 1);
  for (std::size_t i = closing.size(); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\')
      ++i;
    else if (text.substr(i).starts_with(closing))
      return i + closing.size();
    else if (!is_long && text[i] == '\n')
      return i;
  }
  return text.size();
}

}  // namespace

std::optional<TextPlace> find_deep_key(std::string_view text) {
  // Dots in a row, with nothing but parts of keys between them. A number has at most one.
  std::size_t dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i += string_length(text.substr(i));
      continue;
    }
    if (c == '#') i = std::min(text.find('\n', i), text.size() - 1);
    if (std::string_view("=,[]{}\n").find(text[i]) != std::string_view::npos) dots = 0;
    if (c == '.' && ++dots >= most_key_parts) {
      const std::string_view before = text.substr(0, i);
      return TextPlace{static_cast<unsigned>(1 + std::ranges::count(before, '\n')),
                       static_cast<unsigned>(i - (before.find_last_of('\n') + 1) + 1)};
    }
    ++i;
  }
  return std::nullopt;
}

}  // namespace vitrum::scene
