#pragma once
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace vitrum::output {

/// Writes `text` so that `path` holds either what it held before or all of `text`, whenever the process or
/// the machine stops: a hidden file beside it is written, forced to disk and renamed over it. Throws
/// FileError.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

/// Name of the hidden file beside `path` that is prepared to take its place: "DIR/.NAME.next".
std::filesystem::path next_of(const std::filesystem::path& path);

/// Forces `path` to disk, renames it to `target` (replacing it) and forces the directory to disk. Throws
/// FileError.
void replace_with(const std::filesystem::path& path, const std::filesystem::path& target);

/// Forces `path` to disk and lets `path` and `target`, which must both exist, change names in one atomic
/// step. Returns false, with nothing changed, where the file system cannot do that. Throws FileError
/// otherwise.
bool exchange_with(const std::filesystem::path& path, const std::filesystem::path& target);

/// Makes the existing file `path` at least `bytes` long, with all of it backed by disk space. Throws
/// FileError when there is not enough. To be called before HDF5 writes: HDF5 1.10 does not survive a full
/// disk (it crashes when it closes the file).
void reserve_space(const std::filesystem::path& path, std::uint64_t bytes);

}  // namespace vitrum::output
