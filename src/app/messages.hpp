#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "scene/input_text.hpp"

namespace vitrum::app {

/// Prints text on standard error as it stands. What cannot be printed (a terminal that has gone, a full disk,
/// a broken pipe) is lost: no run ends for it.
void tell_text(std::string_view text);

/// The same for formatted text.
template <class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  tell_text(fmt::format(format, std::forward<Values>(values)...));
}

/// From now on messages show the lines of this input, and of these --set arguments, that they name. Returns
/// the input.
const InputText& show_lines_of(InputText input, std::vector<std::string> overrides);

/// Messages, each one fact on a line that begins with its kind: `error: FILE:LINE:COLUMN: ...`. Below it may
/// stand what the message is about (excerpt.hpp). On a terminal lines are wrapped, and coloured unless the
/// environment has NO_COLOR.
void complain(std::string_view message);
void warn(std::string_view message);
void tell_interrupted(std::string_view message);

/// Prints text on standard output. Throws FileError when it cannot be written, but not when its reader has
/// gone: that one wants no more.
void show(std::string_view text);

/// An argument as a shell takes it, on one line: one with line breaks or other control characters in the form
/// $'..', which bash and POSIX 2024 know.
std::string shell_quoted(const std::string& argument);

/// Opens /dev/null for each of the standard streams that the program was started without: otherwise the next
/// file opened would take its place, and be written messages into.
void open_standard_streams();

}  // namespace vitrum::app
