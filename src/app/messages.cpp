#include "app/messages.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "app/excerpt.hpp"
#include "app/terminal.hpp"
#include "scene/input_error.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::app {
namespace {

constexpr std::string_view red = "\033[1;31m", yellow = "\033[1;33m", plain = "\033[0m";

struct ShownInput {
  InputText input;
  std::vector<std::string> overrides;
};
ShownInput& shown_input() {
  static ShownInput shown;
  return shown;
}

bool in_colour() {
  const char* refusal = std::getenv("NO_COLOR");
  return on_terminal() && (refusal == nullptr || *refusal == '\0');
}

void tell_message(std::string_view kind, std::string_view colour, std::string_view message) {
  constexpr std::size_t wide = 120;  // of an excerpt where there is no terminal
  const bool terminal = on_terminal();
  // Names of files may hold ends of lines.
  std::string text = fmt::format("{}: {}", kind, scene::single_line(message));
  if (terminal) text = wrapped(text, terminal_columns());
  if (in_colour()) text = fmt::format("{}{}:{}{}", colour, kind, plain, text.substr(kind.size() + 1));
  const auto& [input, overrides] = shown_input();
  tell_text(text + '\n' + excerpt(message, input, overrides, terminal ? terminal_columns() : wide));
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

std::string quoted_with_escapes(const std::string& argument) {
  std::string text = "$'";
  for (const char c : argument)
    text += is_control(c)            ? fmt::format("\\{:03o}", static_cast<unsigned char>(c))
            : c == '\'' || c == '\\' ? fmt::format("\\{}", c)
                                     : std::string(1, c);
  return text + "'";
}

}  // namespace

void tell_text(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

const InputText& show_lines_of(InputText input, std::vector<std::string> overrides) {
  shown_input() = {std::move(input), std::move(overrides)};
  return shown_input().input;
}

void complain(std::string_view message) {
  tell_message("error", red, message);
}

void warn(std::string_view message) {
  tell_message("warning", yellow, message);
}

void tell_interrupted(std::string_view message) {
  tell_message("interrupted", yellow, message);
}

void show(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  if (errno != EPIPE)
    throw FileError(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
}

std::string shell_quoted(const std::string& argument) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("_-+=./:,@%", c) != nullptr;
  };
  if (!argument.empty() && std::all_of(argument.begin(), argument.end(), plain)) return argument;
  if (std::ranges::any_of(argument, is_control)) return quoted_with_escapes(argument);
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

void open_standard_streams() {
  for (int stream = 0; stream < 3; ++stream)
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      (void)!open("/dev/null", O_RDWR);  // takes the lowest number free
}

}  // namespace vitrum::app
