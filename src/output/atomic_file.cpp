#include "output/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "scene/input_error.hpp"

namespace vitrum::output {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view action, int reason) {
  throw FileError(fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(reason)));
}

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : path_(path), number_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (number_ < 0) fail(path, "open", errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }

  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = ::write(number_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(path_, "write", errno);
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void sync() {
    // Some file systems cannot synchronise a directory and say EINVAL; there is nothing better to be had
    // there.
    if (fsync(number_) != 0 && errno != EINVAL) fail(path_, "force to disk", errno);
  }

  void reserve(std::uint64_t bytes) {
    const int reason = posix_fallocate(number_, 0, static_cast<off_t>(bytes));
    if (reason != 0) fail(path_, fmt::format("reserve {} bytes", bytes), reason);
  }

  void close() {
    if (::close(std::exchange(number_, -1)) != 0) fail(path_, "close", errno);
  }

 private:
  std::filesystem::path path_;
  int number_;
};

void sync_directory_of(const std::filesystem::path& path) {
  const std::filesystem::path directory = path.has_parent_path() ? path.parent_path() : ".";
  Descriptor(directory, O_RDONLY | O_DIRECTORY).sync();
}

}  // namespace

std::filesystem::path next_of(const std::filesystem::path& path) {
  return path.parent_path() / ("." + path.filename().string() + ".next");
}

void write_text_atomically(const std::filesystem::path& path, std::string_view text) {
  const std::filesystem::path next = next_of(path);
  Descriptor file(next, O_WRONLY | O_CREAT | O_TRUNC);
  file.write(text);
  file.close();
  replace_with(next, path);
}

void replace_with(const std::filesystem::path& path, const std::filesystem::path& target) {
  Descriptor(path, O_RDONLY).sync();
  if (std::rename(path.c_str(), target.c_str()) != 0) fail(target, "replace", errno);
  sync_directory_of(target);
}

void reserve_space(const std::filesystem::path& path, std::uint64_t bytes) {
  Descriptor(path, O_WRONLY).reserve(bytes);
}

bool exchange_with(const std::filesystem::path& path, const std::filesystem::path& target) {
  Descriptor(path, O_RDONLY).sync();
  if (renameat2(AT_FDCWD, path.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) != 0) {
    if (errno == EINVAL || errno == ENOSYS || errno == EOPNOTSUPP) return false;
    fail(target, "exchange with its successor", errno);
  }
  sync_directory_of(target);
  return true;
}

}  // namespace vitrum::output
