#include "output/atomic_file.hpp"

#include <fcntl.h>

#include <cerrno>
#include <cstdio>

#include "output/descriptor.hpp"

namespace vitrum::output {
namespace {

enum class Force { no, yes };

/// Gives `next` the name `path`. Where there is such a file and neither is to be forced to disk, the two
/// change names, and the former is removed: a file that is renamed over another is written to disk at once by
/// ext4, for whose removal at the next renewal one would have to wait. The renewal is done when they have
/// changed names: a former one that cannot be removed is no failure, and is written over by the next.
void rename_to(const std::filesystem::path& next, const std::filesystem::path& path, Force force) {
  if (force == Force::no && renameat2(AT_FDCWD, next.c_str(), AT_FDCWD, path.c_str(), RENAME_EXCHANGE) == 0) {
    std::error_code left;
    std::filesystem::remove(next, left);
    return;
  }
  if (std::rename(next.c_str(), path.c_str()) != 0) throw_file_error(path, "replace", errno);
}

void write_and_rename(const std::filesystem::path& path, std::string_view text, Force force) {
  const std::filesystem::path next = next_of(path);
  try {
    Descriptor file(next, O_WRONLY | O_CREAT | O_TRUNC);
    file.write(text);
    if (force == Force::yes) file.sync();
    file.close();
    rename_to(next, path, force);
  } catch (...) {
    std::error_code missing;
    std::filesystem::remove(next, missing);
    throw;
  }
  if (force == Force::no) return;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  Descriptor(folder, O_RDONLY | O_DIRECTORY).sync();
}

}  // namespace

std::filesystem::path next_of(const std::filesystem::path& path) {
  return path.parent_path() / ("." + path.filename().string() + ".next");
}

void put_in_place(const std::filesystem::path& path, std::string_view text) {
  write_and_rename(path, text, Force::no);
}

void write_text_atomically(const std::filesystem::path& path, std::string_view text) {
  write_and_rename(path, text, Force::yes);
}

void force_to_disk(const std::filesystem::path& folder) {
  Descriptor(folder, O_RDONLY | O_DIRECTORY).sync_file_system();
}

void remove_file(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) throw_file_error(path, "remove", error.value());
}

}  // namespace vitrum::output
