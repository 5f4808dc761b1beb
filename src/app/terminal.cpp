#include "app/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace vitrum::app {

bool on_terminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && (kind == nullptr || std::string_view(kind) != "dumb");
}

std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::size_t columns_of(std::string_view text) {
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; };
  return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, continues));
}

namespace {

/// The word that the text begins with, with the blanks before it.
std::string_view first_word(std::string_view text) {
  std::size_t end = text.find_first_not_of(' ');
  bool in_command = false;
  for (; end < text.size() && (in_command || text[end] != ' '); ++end)
    if (text[end] == '`') in_command = !in_command;
  return text.substr(0, end);
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t columns) {
  constexpr std::string_view indent = "  ";
  std::string lines;
  std::size_t used = 0;
  while (!text.empty()) {
    const std::string_view word = first_word(text);
    text.remove_prefix(word.size());
    const bool fits = used + columns_of(word) <= columns;
    if (used > 0 && !fits) {
      const std::string_view bare = word.substr(std::min(word.find_first_not_of(' '), word.size()));
      if (bare.empty()) break;
      lines.append("\n").append(indent).append(bare);
      used = indent.size() + columns_of(bare);
    } else {
      lines += word;
      used += columns_of(word);
    }
  }
  return lines;
}

}  // namespace vitrum::app
