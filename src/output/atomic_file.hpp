#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

namespace vitrum::output {

/// Writes `text` so that `path` holds either what it held before or all of `text`, whenever the process or
/// the machine stops: a hidden file beside it is written, forced to disk and renamed over it. Throws
/// FileError.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

/// The same for what `write` writes into the file whose path it is given. When it or what follows throws, the
/// hidden file is removed: it may hold the space that is missing.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

/// Name of the hidden file beside `path` that is prepared to take its place: "DIR/.NAME.next".
std::filesystem::path next_of(const std::filesystem::path& path);

/// Forces `path` to disk, renames it to `target` (replacing it) and forces the directory to disk. Throws
/// FileError.
void replace_with(const std::filesystem::path& path, const std::filesystem::path& target);

/// Forces `path` to disk and lets `path` and `target`, which must both exist, change names in one atomic
/// step. Returns false, with nothing changed, where the file system cannot do that. Throws FileError
/// otherwise.
bool exchange_with(const std::filesystem::path& path, const std::filesystem::path& target);

/// Removes the file if there is one. Throws FileError.
void remove_file(const std::filesystem::path& path);

}  // namespace vitrum::output
