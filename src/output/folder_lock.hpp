#pragma once
#include <filesystem>
#include <string>

#include "output/descriptor.hpp"

namespace vitrum::output {

/// Holds a folder for this process: while the object lives no other process gets a FolderLock on it. The lock
/// is the system's (flock on the hidden file .vitrum.lock), so it goes with the process, however that ends; a
/// lock file that is left behind holds nobody up.
class FolderLock {
 public:
  static constexpr const char* file_name = ".vitrum.lock";

  /// Locks an existing folder. Throws InputError, which says who holds it, or FileError.
  explicit FolderLock(std::filesystem::path folder);
  FolderLock(FolderLock&&) = default;
  ~FolderLock();

  const std::filesystem::path& folder() const { return folder_; }
  /// False where the file system has no locks.
  bool locked() const { return locked_; }
  /// Whether folder() still leads to the folder that was locked, and no other process has locked it since.
  /// Either may happen when somebody moves, removes or clears the folder: then its files may belong to
  /// another run. A lock file that has only been removed is made again.
  bool holds();

 private:
  void acquire();
  bool take();
  bool file_in_place() const;

  std::filesystem::path folder_;
  Descriptor place_;  ///< keeps the folder's identity from being used again
  Descriptor file_;
  bool locked_ = false, lost_ = false;
};

}  // namespace vitrum::output
