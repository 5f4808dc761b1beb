#pragma once
#include <cstdint>
#include <filesystem>

#include "analysis/energy_totals.hpp"
#include "output/descriptor.hpp"

namespace vitrum::output {

/// The file energy.csv: time (s), step, and the energies of EnergyTotals (J) as given, a line a row. Every
/// row reaches the operating system before append() returns, so that a killed process loses none; a row that
/// cannot be written whole (disk full) is taken back. Numbers round-trip. All functions throw FileError.
class EnergyCsv {
 public:
  static constexpr const char* header =
      "time,step,kinetic,elastic,plastic,damage,fracture,external,residual,contact,friction";

  static EnergyCsv create(const std::filesystem::path& path);
  /// Continues a file, keeping its first `rows` rows. Throws FileError when it has fewer or another header.
  static EnergyCsv reopen(const std::filesystem::path& path, std::size_t rows);

  void append(double time, std::int64_t step, const EnergyTotals& energy);
  /// Rows written, the header not counted.
  std::size_t rows() const { return rows_; }

 private:
  EnergyCsv(const std::filesystem::path& path, std::size_t rows);

  Descriptor file_;
  std::uint64_t size_;  ///< bytes of whole rows
  std::size_t rows_;
};

}  // namespace vitrum::output
