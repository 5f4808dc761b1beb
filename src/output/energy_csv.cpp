#include "output/energy_csv.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <fstream>
#include <string>

#include "output/atomic_file.hpp"
#include "output/regular_file.hpp"
#include "scene/input_error.hpp"

namespace vitrum::output {

EnergyCsv::EnergyCsv(const std::filesystem::path& path, std::size_t rows)
    : file_(path, O_WRONLY | O_APPEND), size_(file_.size()), rows_(rows) {}

EnergyCsv EnergyCsv::create(const std::filesystem::path& path) {
  write_text_atomically(path, std::string(header) + '\n');
  return EnergyCsv(path, 0);
}

EnergyCsv EnergyCsv::reopen(const std::filesystem::path& path, std::size_t rows) {
  require_regular_file(path);
  std::ifstream old(path);
  std::string line, kept;
  if (!old || !std::getline(old, line) || line != header)
    throw FileError(fmt::format("{}: cannot continue: the first line is not '{}'", path.string(), header));
  kept = line + '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    // A line without its end was cut off by a kill.
    if (!std::getline(old, line) || old.eof())
      throw FileError(
          fmt::format("{}: holds {} rows, fewer than the {} that were written before the checkpoint",
                      path.string(), row, rows));
    kept += line + '\n';
  }
  write_text_atomically(path, kept);
  return EnergyCsv(path, rows);
}

void EnergyCsv::append(double time, std::int64_t step, const EnergyTotals& energy) {
  const std::string line = fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", time, step, energy.kinetic,
                                       energy.elastic, energy.plastic, energy.damage, energy.fracture,
                                       energy.external, energy.residual(), energy.contact, energy.friction);
  try {
    file_.write(line);
  } catch (const FileError&) {
    file_.truncate(size_);
    throw;
  }
  size_ += line.size();
  ++rows_;
}

}  // namespace vitrum::output
