#include "output/descriptor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/sendfile.h>
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

FileVersion Descriptor::version() const {
  struct stat status {};
  if (fstat(number_, &status) != 0) fail("tell size and time", errno);
  return {status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size), status.st_mtim.tv_sec,
          status.st_mtim.tv_nsec};
}

bool Descriptor::lock_for_writing() {
  return lock_file(number_, true);
}

bool Descriptor::lock_for_reading() {
  return lock_file(number_, false);
}

void Descriptor::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(number_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write", errno);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void Descriptor::write_all_of(const Descriptor& source) {
  constexpr std::size_t at_a_time = std::size_t{1} << 30;
  ssize_t written = 0;
  do written = sendfile(number_, source.number_, nullptr, at_a_time);
  while (written > 0 || (written < 0 && errno == EINTR));
  if (written < 0) fail(fmt::format("copy {} to it", source.path_.string()), errno);
}

void Descriptor::write_part_of(const Descriptor& source, const ByteRange& part) {
  const std::string action = fmt::format("copy {} to it", source.path_.string());
  auto from = static_cast<off_t>(part.begin);
  const auto end = static_cast<off_t>(part.begin + part.size);
  if (lseek(number_, from, SEEK_SET) < 0) fail(action, errno);
  while (from < end) {
    const ssize_t written = sendfile(number_, source.number_, &from, static_cast<std::size_t>(end - from));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(action, written < 0 ? errno : EIO);
  }
}

void Descriptor::truncate(std::uint64_t bytes) {
  if (ftruncate(number_, static_cast<off_t>(bytes)) != 0) fail("shorten", errno);
}

void Descriptor::sync() {
  // Some file systems cannot synchronise a directory and say EINVAL; there is nothing better to be had there.
  if (fsync(number_) != 0 && errno != EINVAL) fail("force to disk", errno);
}

void Descriptor::close() {
  if (::close(std::exchange(number_, -1)) != 0) fail("close", errno);
}

bool lock_file(int descriptor, bool exclusive) {
  return flock(descriptor, (exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

}  // namespace vitrum::output
