#include "scene/csv_rows.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "scene/input_error.hpp"
#include "scene/input_text.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<double> number_of(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Whether a cell is no number, but was meant to be one.
bool resembles_number(std::string_view text) {
  text = trimmed(text);
  const auto begin = text.find_first_not_of("\"'+-. ");
  if (begin == std::string_view::npos) return false;
  text.remove_prefix(begin);
  return (text[0] >= '0' && text[0] <= '9') || text == "nan" || text == "inf";
}

}  // namespace

std::variant<std::vector<CsvRow>, std::string> read_csv_rows(const std::filesystem::path& folder,
                                                             const std::string& name) {
  const std::string file = (folder / name).string();
  std::string text;
  try {
    text = read_file(file, "a CSV file");
  } catch (const std::runtime_error& error) {
    return std::string(error.what());
  }
  if (constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF"; text.starts_with(byte_order_mark))
    text.erase(0, byte_order_mark.size());
  std::vector<CsvRow> rows;
  bool first = true;
  int number = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t length = rest.find('\n');
    const std::string_view line = trimmed(rest.substr(0, length));
    rest = length == std::string_view::npos ? std::string_view{} : rest.substr(length + 1);
    ++number;
    if (line.empty() || line.starts_with('#')) continue;
    const std::size_t comma = line.find_first_of(",;");
    const std::string_view left = line.substr(0, comma), right = comma == std::string_view::npos
                                                                     ? std::string_view{}
                                                                     : line.substr(comma + 1);
    const auto a = number_of(left), b = number_of(right);
    if (a && b)
      rows.push_back({number, {*a, *b}});
    else if (!first || resembles_number(left) || resembles_number(right))
      return fmt::format("{}:{}: found {}, expected two numbers and a comma between", file, number,
                         toml_quoted(line.substr(0, 60)));
    first = false;
  }
  return rows;
}

}  // namespace vitrum::scene
