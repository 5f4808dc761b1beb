#pragma once
#include <filesystem>

namespace vitrum::output {

/// Throws FileError when `path` is something else than a regular file: a directory, a pipe (which would be
/// waited for), or a device (which may be read without end). What does not exist is left to whoever opens it.
void require_regular_file(const std::filesystem::path& path);

}  // namespace vitrum::output
