#pragma once
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "output/descriptor.hpp"

namespace vitrum::output {

/// A file of rows that grows by whole lines. What append() was given reaches the operating system before it
/// returns, so that a killed process loses none of it; rows that cannot be written whole (disk full) are
/// taken back. All functions throw FileError.
class CsvFile {
 public:
  /// A new file with its first line, forced to disk.
  static CsvFile create(const std::filesystem::path& path, std::string_view columns);
  /// Continues a file, keeping its first `size` bytes. Throws FileError when it has fewer, another first
  /// line, or no line that ends there.
  static CsvFile reopen(const std::filesystem::path& path, std::string_view columns, std::uint64_t size);

  /// rows: whole lines.
  void append(std::string_view rows);
  /// Bytes of whole lines.
  std::uint64_t size() const { return size_; }

 private:
  explicit CsvFile(const std::filesystem::path& path);

  Descriptor file_;
  std::uint64_t size_;
};

}  // namespace vitrum::output
