#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>

namespace vitrum::app {

/// Prints text on standard error as it stands. What cannot be printed (a terminal that has gone, a full disk,
/// a broken pipe) is lost: no run ends for it.
void tell_text(std::string_view text);

/// The same for formatted text.
template <class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  tell_text(fmt::format(format, std::forward<Values>(values)...));
}

/// Prints text on standard output. Throws FileError when it cannot be written, but not when its reader has
/// gone: that one wants no more.
void show(std::string_view text);

/// An argument as a shell takes it.
std::string shell_quoted(const std::string& argument);

/// Opens /dev/null for each of the standard streams that the program was started without: otherwise the next
/// file opened would take its place, and be written messages into.
void open_standard_streams();

}  // namespace vitrum::app
