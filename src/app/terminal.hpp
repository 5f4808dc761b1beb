#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace vitrum::app {

/// Whether standard error is a terminal on which lines can be drawn anew.
bool on_terminal();

/// How many columns that terminal has now; 80 where it does not say.
std::size_t terminal_columns();

/// The columns that a UTF-8 text takes, one a character.
std::size_t columns_of(std::string_view text);

/// `text` with line breaks instead of blanks, so that no line has more than `columns`; lines after the first
/// are indented. A longer word stays whole, and so does what stands in `backquotes`: a command that one
/// copies.
std::string wrapped(std::string_view text, std::size_t columns);

}  // namespace vitrum::app
