#include "output/csv_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <fstream>
#include <string>

#include "output/atomic_file.hpp"
#include "output/regular_file.hpp"
#include "scene/input_error.hpp"

namespace vitrum::output {

CsvFile::CsvFile(const std::filesystem::path& path) : file_(path, O_WRONLY | O_APPEND), size_(file_.size()) {}

CsvFile CsvFile::create(const std::filesystem::path& path, std::string_view columns) {
  write_text_atomically(path, fmt::format("{}\n", columns));
  return CsvFile(path);
}

CsvFile CsvFile::reopen(const std::filesystem::path& path, std::string_view columns, std::uint64_t size) {
  require_regular_file(path);
  std::ifstream old(path, std::ios::binary);
  std::string line;
  if (!old || !std::getline(old, line) || line != columns)
    throw FileError(fmt::format("{}: cannot continue: the first line is not '{}'", path.string(), columns));
  CsvFile file(path);
  if (file.size_ < size)
    throw FileError(
        fmt::format("{}: holds {} bytes, fewer than the {} that were written before the checkpoint",
                    path.string(), file.size_, size));
  old.seekg(static_cast<std::streamoff>(size) - 1);
  if (size <= columns.size() || old.get() != '\n')
    throw FileError(
        fmt::format("{}: cannot continue: no line ends at byte {}, where one did at the checkpoint",
                    path.string(), size));
  file.file_.truncate(size);
  file.size_ = size;
  return file;
}

void CsvFile::append(std::string_view rows) {
  try {
    file_.write(rows);
  } catch (const FileError&) {
    file_.truncate(size_);
    throw;
  }
  size_ += rows.size();
}

}  // namespace vitrum::output
