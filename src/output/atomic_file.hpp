#pragma once
#include <filesystem>
#include <string_view>

namespace vitrum::output {

/// Writes `text` so that `path` holds either what it held before or all of `text`, whenever the process
/// stops: a hidden file beside it is written and renamed over it; when that fails it is removed: it may hold
/// the space that is missing. Whether a power cut finds it on disk is left to the system, until
/// force_to_disk(). Throws FileError.
void put_in_place(const std::filesystem::path& path, std::string_view text);

/// The same, also when the machine stops: forced to disk.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

/// Forces to disk all that has been written in `folder`, by one call however many files that are; it waits
/// for what others have written to the same file system. Throws FileError.
void force_to_disk(const std::filesystem::path& folder);

/// Name of the hidden file beside `path` that is prepared to take its place: "DIR/.NAME.next".
std::filesystem::path next_of(const std::filesystem::path& path);

/// Removes the file if there is one. Throws FileError.
void remove_file(const std::filesystem::path& path);

}  // namespace vitrum::output
