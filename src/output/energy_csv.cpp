#include "output/energy_csv.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "output/atomic_file.hpp"
#include "output/regular_file.hpp"
#include "scene/input_error.hpp"

namespace vitrum::output {
namespace {
constexpr const char* header = "time,step,kinetic,elastic,plastic,damage,fracture,external,residual";
}

EnergyCsv::EnergyCsv(const std::filesystem::path& path, const char* mode, std::size_t rows)
    : path_(path), file_(std::fopen(path.c_str(), mode), std::fclose), rows_(rows) {
  if (!file_) throw FileError(fmt::format("{}: cannot open: {}", path.string(), std::strerror(errno)));
}

EnergyCsv EnergyCsv::create(const std::filesystem::path& path) {
  write_text_atomically(path, std::string(header) + '\n');
  return EnergyCsv(path, "ae", 0);
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
  return EnergyCsv(path, "ae", rows);
}

void EnergyCsv::append(double time, std::int64_t step, const EnergyTotals& energy) {
  const std::string line =
      fmt::format("{},{},{},{},{},{},{},{},{}\n", time, step, energy.kinetic, energy.elastic, energy.plastic,
                  energy.damage, energy.fracture, energy.external, energy.residual());
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0)
    throw FileError(fmt::format("{}: cannot write: {}", path_.string(), std::strerror(errno)));
  ++rows_;
}

}  // namespace vitrum::output
