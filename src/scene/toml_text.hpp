#pragma once
#include <string>
#include <string_view>

namespace vitrum::scene {

/// Shortest decimal text that TOML reads back as the same double, always a TOML float ("0.2", "3.0", "1e-06",
/// "-inf").
std::string number_text(double value);

/// TOML basic string with its quotes; control characters are escaped, so the result is a single line.
std::string toml_quoted(std::string_view text);

/// A key as TOML writes it: bare where possible, else quoted.
std::string key_text(std::string_view key);

/// `path` extended by one key or list index; an empty path is the document itself.
std::string join_path(std::string_view path, std::string_view key);
std::string join_path(std::string_view path, std::size_t index);

/// Whether a text holds control characters (line breaks among them, Unicode's, too).
bool has_control_characters(std::string_view text);

/// `text` with every control character replaced by a space: messages are single lines.
std::string single_line(std::string_view text);

}  // namespace vitrum::scene
