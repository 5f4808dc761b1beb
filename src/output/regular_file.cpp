#include "output/regular_file.hpp"

#include <fmt/format.h>

#include <system_error>

#include "scene/input_error.hpp"

namespace vitrum::output {

void require_regular_file(const std::filesystem::path& path) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw FileError(fmt::format("{}: cannot read: it is not a regular file", path.string()));
}

}  // namespace vitrum::output
