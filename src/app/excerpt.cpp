#include "app/excerpt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "scene/toml_text.hpp"

namespace vitrum::app {
namespace {

/// Takes a number followed by `end` from the beginning of a text.
std::optional<std::size_t> take_number(std::string_view& text, std::string_view end) {
  std::size_t number = 0;
  const auto [behind, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::string_view rest = text.substr(static_cast<std::size_t>(behind - text.data()));
  if (error != std::errc{} || !rest.starts_with(end)) return std::nullopt;
  text = rest.substr(end.size());
  return number;
}

struct Place {
  std::size_t line, column;  // from 1
};

std::optional<Place> place_in(std::string_view message, std::string_view name) {
  if (!message.starts_with(name) || message.substr(name.size(), 1) != ":") return std::nullopt;
  message.remove_prefix(name.size() + 1);
  const auto line = take_number(message, ":");
  const auto column = line ? take_number(message, ": ") : std::nullopt;
  if (!column || *line == 0 || *column == 0) return std::nullopt;
  return Place{*line, *column};
}

std::optional<std::string_view> line_of(std::string_view text, std::size_t number) {
  for (; number > 1; --number) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

/// Bytes of the UTF-8 character that the text begins with; 0: it does not begin with one.
std::size_t character_bytes(std::string_view text) {
  const auto byte = static_cast<unsigned char>(text.front());
  const std::size_t bytes = byte < 0x80   ? 1
                            : byte < 0xc2 ? 0
                            : byte < 0xe0 ? 2
                            : byte < 0xf0 ? 3
                            : byte < 0xf5 ? 4
                                          : 0;
  const std::string_view rest = text.substr(1, bytes > 0 ? bytes - 1 : 0);
  const bool whole = rest.size() + 1 == bytes && std::ranges::all_of(rest, [](char c) {
                       return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
                     });
  return whole ? bytes : 0;
}

/// So many characters behind the first `skipped` ones; what is not UTF-8 as question marks.
std::string part_of(std::string_view line, std::size_t skipped, std::size_t count) {
  std::string part;
  for (std::size_t n = 0; n < skipped + count && !line.empty(); ++n) {
    const std::size_t bytes = character_bytes(line);
    if (n >= skipped) part += bytes == 0 ? std::string_view("?") : line.substr(0, bytes);
    line.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return scene::single_line(part);
}

}  // namespace

std::string excerpt(std::string_view message, const InputText& input, std::span<const std::string> overrides,
                    std::size_t columns) {
  constexpr std::size_t margin = 8;
  const std::size_t room = columns > margin + 8 ? columns - margin : 8;
  constexpr std::string_view set = "--set ";
  if (message.starts_with(set)) {
    message.remove_prefix(set.size());
    const auto number = take_number(message, ": ");
    if (!number || *number == 0 || *number > overrides.size()) return "";
    return fmt::format("{:>{}}{}\n", "| ", margin, part_of(set.data() + overrides[*number - 1], 0, room));
  }
  const auto place = place_in(message, input.name);
  const auto line = place ? line_of(input.text, place->line) : std::nullopt;
  if (!line) return "";
  // Of a line that is too long, the part around the column.
  const std::size_t skipped = place->column <= room ? 0 : place->column - room / 2;
  return fmt::format("{:>{}} | {}\n{:>{}}{:>{}}\n", place->line, margin - 3, part_of(*line, skipped, room),
                     "| ", margin, '^', place->column - skipped);
}

}  // namespace vitrum::app
