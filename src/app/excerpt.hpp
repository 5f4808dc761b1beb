#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "scene/input_text.hpp"

namespace vitrum::app {

/// What a message shows below itself, so that nobody has to look it up: the line of the input that it names
/// by `NAME:LINE:COLUMN: `, with a caret under the column, or the argument that it names by `--set N: `. Two
/// lines of at most so many columns, or one; empty where the message names neither.
std::string excerpt(std::string_view message, const InputText& input, std::span<const std::string> overrides,
                    std::size_t columns);

}  // namespace vitrum::app
