#include "output/descriptor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "scene/input_error.hpp"

namespace vitrum::output {

void throw_file_error(const std::filesystem::path& path, std::string_view action, int reason) {
  throw FileError(fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(reason)));
}

Descriptor::Descriptor(const std::filesystem::path& path, int flags)
    : path_(path), number_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {
  if (number_ < 0) fail("open", errno);
}

Descriptor::Descriptor(const Descriptor& folder, const std::filesystem::path& name, int flags)
    : path_(folder.path_ / name), number_(openat(folder.number_, name.c_str(), flags | O_CLOEXEC, 0666)) {
  if (number_ < 0) fail("open", errno);
}

Descriptor::Descriptor(Descriptor&& other) noexcept
    : path_(std::move(other.path_)), number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(path_, other.path_), std::swap(number_, other.number_);
  return *this;
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

void Descriptor::fail(std::string_view action, int reason) const {
  throw_file_error(path_, action, reason);
}

std::uint64_t Descriptor::size() const {
  struct stat status {};
  if (fstat(number_, &status) != 0) fail("tell its size", errno);
  return static_cast<std::uint64_t>(status.st_size);
}

void Descriptor::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(number_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write", errno);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void Descriptor::truncate(std::uint64_t bytes) {
  if (ftruncate(number_, static_cast<off_t>(bytes)) != 0) fail("shorten", errno);
}

void Descriptor::sync() {
  // Some file systems cannot synchronise a directory and say EINVAL; there is nothing better to be had there.
  if (fsync(number_) != 0 && errno != EINVAL) fail("force to disk", errno);
}

void Descriptor::sync_file_system() {
  if (syncfs(number_) != 0 && errno != EINVAL) fail("force to disk", errno);
}

void Descriptor::close() {
  if (::close(std::exchange(number_, -1)) != 0) fail("close", errno);
}

}  // namespace vitrum::output
