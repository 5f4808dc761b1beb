#include "output/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "output/provenance.hpp"
#include "scene/input_error.hpp"

namespace vitrum::output {
namespace {

bool same(const struct stat& one, const struct stat& other) {
  return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

/// What the holder wrote into its lock file; it may have had no space to.
std::string holder(int descriptor) {
  std::array<char, 256> text{};
  const ssize_t count = pread(descriptor, text.data(), text.size(), 0);
  return count > 0 ? std::string(text.data(), static_cast<std::size_t>(count)) : "another process";
}

}  // namespace

FolderLock::FolderLock(std::filesystem::path folder)
    : folder_(std::move(folder)),
      place_(folder_, O_RDONLY | O_DIRECTORY),
      file_(place_, file_name, O_RDWR | O_CREAT) {
  acquire();
}

void FolderLock::acquire() {
  // Its holder may have removed the file between our opening and our locking it: then the lock is worth
  // nothing.
  while (!take()) file_ = Descriptor(place_, file_name, O_RDWR | O_CREAT);
  if (!locked_) return;
  try {
    file_.truncate(0);
    file_.write(fmt::format("process {} on {}, since {}", getpid(), host_name(), utc_now()));
  } catch (const FileError&) {
    // Only a message of another process becomes poorer.
  }
}

/// Locks the open file; whether that is (still) the file that others will open.
bool FolderLock::take() {
  if (flock(file_.number(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) return false;
    if (errno == EWOULDBLOCK)
      throw InputError(
          fmt::format("{}: found a run under way here ({}), expected a folder of its own for every run: wait "
                      "for that one or stop it, or choose another --out",
                      folder_.string(), holder(file_.number())));
    if (errno == ENOLCK || errno == ENOSYS || errno == EOPNOTSUPP || errno == EINVAL) return true;
    throw_file_error(folder_ / file_name, "lock", errno);
  }
  locked_ = file_in_place();
  return locked_;
}

bool FolderLock::file_in_place() const {
  struct stat ours = {}, there = {};
  return fstat(file_.number(), &ours) == 0 && fstatat(place_.number(), file_name, &there, 0) == 0 &&
         same(ours, there);
}

FolderLock::~FolderLock() {
  // By the folder that was locked, not by its path, which may lead elsewhere by now.
  if (place_.number() >= 0 && file_.number() >= 0 && !lost_ && file_in_place())
    unlinkat(place_.number(), file_name, 0);
}

bool FolderLock::holds() {
  struct stat ours = {}, there = {};
  if (fstat(place_.number(), &ours) != 0 || stat(folder_.c_str(), &there) != 0 || !same(ours, there))
    return false;
  if (!locked_ || file_in_place()) return !lost_;
  try {
    file_ = Descriptor(place_, file_name, O_RDWR | O_CREAT);
    acquire();
  } catch (const std::runtime_error&) {  // another holds it, or it cannot be made
    lost_ = true;
  }
  return !lost_;
}

}  // namespace vitrum::output
