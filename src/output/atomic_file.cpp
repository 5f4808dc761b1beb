#include "output/atomic_file.hpp"

#include <fcntl.h>

#include <cerrno>
#include <cstdio>

#include "output/descriptor.hpp"

namespace vitrum::output {
namespace {

void sync_directory_of(const std::filesystem::path& path) {
  const std::filesystem::path directory = path.has_parent_path() ? path.parent_path() : ".";
  Descriptor(directory, O_RDONLY | O_DIRECTORY).sync();
}

}  // namespace

std::filesystem::path next_of(const std::filesystem::path& path) {
  return path.parent_path() / ("." + path.filename().string() + ".next");
}

void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write) {
  const std::filesystem::path next = next_of(path);
  try {
    write(next);
    replace_with(next, path);
  } catch (...) {
    std::error_code missing;
    std::filesystem::remove(next, missing);
    throw;
  }
}

void write_text_atomically(const std::filesystem::path& path, std::string_view text) {
  write_atomically(path, [text](const std::filesystem::path& next) {
    Descriptor file(next, O_WRONLY | O_CREAT | O_TRUNC);
    file.write(text);
    file.close();
  });
}

void replace_with(const std::filesystem::path& path, const std::filesystem::path& target) {
  Descriptor(path, O_RDONLY).sync();
  if (std::rename(path.c_str(), target.c_str()) != 0) throw_file_error(target, "replace", errno);
  sync_directory_of(target);
}

bool exchange_with(const std::filesystem::path& path, const std::filesystem::path& target) {
  Descriptor(path, O_RDONLY).sync();
  if (renameat2(AT_FDCWD, path.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) != 0) {
    if (errno == EINVAL || errno == ENOSYS || errno == EOPNOTSUPP) return false;
    throw_file_error(target, "exchange with its successor", errno);
  }
  sync_directory_of(target);
  return true;
}

void remove_file(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) throw_file_error(path, "remove", error.value());
}

}  // namespace vitrum::output
