#include "output/table_store.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "output/atomic_file.hpp"
#include "output/hdf5.hpp"
#include "output/result_layout.hpp"
#include "scene/input_error.hpp"

namespace vitrum::output {
namespace {

/// The cells of a line; quotes are undone.
void split(const std::string& line, std::vector<std::string>& cells) {
  cells.assign(1, "");
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"')
      cells.back() += line[++k];
    else if (line[k] == '"')
      quoted = !quoted;
    else if (line[k] == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[k];
  }
}

/// One column as it is read.
class StoredColumn {
 public:
  explicit StoredColumn(const Column& column) : column_(column) {}

  /// False: it is neither a number nor empty.
  bool add(const std::string& cell) {
    if (column_.unit.empty()) {
      const auto [entry, added] = number_.try_emplace(cell, static_cast<std::uint32_t>(names_.size()));
      if (added) names_.push_back(cell);
      indices_.push_back(entry->second);
      return true;
    }
    double value = std::numeric_limits<double>::quiet_NaN();
    const char* end = cell.data() + cell.size();
    const auto [at, error] = std::from_chars(cell.data(), end, value);
    numbers_.push_back(value);
    return cell.empty() || (at == end && error == std::errc());
  }

  void write(const Group& group, bool per_metre) const {
    const std::string name(column_.name);
    if (column_.unit.empty()) {
      group.write(name, indices_);
      group.write_texts(name + "_names", names_);
    } else {
      group.write(name, numbers_);
    }
    const std::string unit(column_.unit.empty() ? "1" : column_.unit);
    group.set_attribute(name, "unit", column_.of_whole && per_metre ? unit + "/m" : unit);
    group.set_attribute(name, "description", std::string(column_.description));
  }

 private:
  Column column_;
  std::vector<double> numbers_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::string> names_;
  std::map<std::string, std::uint32_t> number_;
};

std::vector<StoredColumn> read_table(const std::filesystem::path& path, const TableInfo& kind) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line) || line != header(kind))
    throw FileError(fmt::format("{}: the first line is not '{}'", path.string(), header(kind)));
  std::vector<StoredColumn> columns(kind.columns.begin(), kind.columns.end());
  std::vector<std::string> cells;
  for (std::size_t number = 2; std::getline(file, line); ++number) {
    split(line, cells);
    bool good = cells.size() == columns.size();
    for (std::size_t k = 0; good && k < cells.size(); ++k) good = columns[k].add(cells[k]);
    if (!good) throw FileError(fmt::format("{}:{}: is no row of '{}'", path.string(), number, header(kind)));
  }
  return columns;
}

}  // namespace

void store_tables(const std::filesystem::path& directory, std::span<const TableInfo> tables, bool per_metre) {
  const std::filesystem::path path = tables_path(directory);
  File file = File::create(path);
  for (const TableInfo& kind : tables) {
    const Group group = file.root().create_group(std::string(kind.name));
    group.set_attribute(".", "description", std::string(kind.description));
    for (const StoredColumn& column : read_table(directory / fmt::format("{}.csv", kind.name), kind))
      column.write(group, per_metre);
  }
  const std::span<const char> bytes = file.close();
  put_in_place(path, {bytes.data(), bytes.size()});
}

}  // namespace vitrum::output
