#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace vitrum::output {

/// Bytes before the HDF5 content of a checkpoint.
inline constexpr std::uint64_t checkpoint_header_size = 512;
inline constexpr std::string_view checkpoint_magic = "vitrum checkpoint 5 sha256 ";

/// The line a checkpoint begins with: format, and the digest of everything behind the header.
inline std::string checkpoint_header(std::string_view digest) {
  return std::string(checkpoint_magic) + std::string(digest) + '\n';
}

}  // namespace vitrum::output
