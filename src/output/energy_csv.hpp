#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "analysis/energy_totals.hpp"

namespace vitrum::output {

/// The file energy.csv: time (s), step, and the energies of EnergyTotals (J) as given, a line a row. Every
/// row reaches the operating system before append() returns, so that a killed process loses none; numbers
/// round-trip. All functions throw FileError.
class EnergyCsv {
 public:
  static EnergyCsv create(const std::filesystem::path& path);
  /// Continues a file, keeping its first `rows` rows. Throws FileError when it has fewer or another header.
  static EnergyCsv reopen(const std::filesystem::path& path, std::size_t rows);

  void append(double time, std::int64_t step, const EnergyTotals& energy);
  /// Rows written, the header not counted.
  std::size_t rows() const { return rows_; }

 private:
  EnergyCsv(const std::filesystem::path& path, const char* mode, std::size_t rows);

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::size_t rows_;
};

}  // namespace vitrum::output
