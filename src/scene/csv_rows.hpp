#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace vitrum::scene {

/// A row, and the line of the file where it stands.
struct CsvRow {
  int line;
  std::array<double, 2> values;
};

/// Rows of two numbers of a CSV file, or what is wrong with it. Lines that are empty or begin with '#', and a
/// first line that does not begin with a number, are passed over. A relative name is looked for in `folder`.
std::variant<std::vector<CsvRow>, std::string> read_csv_rows(const std::filesystem::path& folder,
                                                             const std::string& name);

}  // namespace vitrum::scene
