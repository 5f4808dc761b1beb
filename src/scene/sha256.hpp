#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace vitrum {

/// SHA-256 of `text`, 64 lower-case hexadecimal digits.
std::string sha256(std::string_view text);

/// SHA-256 of a file's bytes from `offset` on. Throws FileError when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path, std::uint64_t offset = 0);

}  // namespace vitrum
