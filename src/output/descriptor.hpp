#pragma once
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace vitrum::output {

/// Bytes of a file.
struct ByteRange {
  std::uint64_t begin = 0, size = 0;
};

/// Differs between files, and when a file has been written to, as finely as its file system tells the time.
struct FileVersion {
  std::uint64_t device = 0, number = 0, size = 0;
  std::int64_t seconds = 0, nanoseconds = 0;  ///< when it was last written to
  bool operator==(const FileVersion&) const = default;
};

/// Owns an open file or directory. Everything throws FileError, which names the path and the system's reason.
class Descriptor {
 public:
  /// flags: of open(2); new files may be read and written by whom the umask allows.
  Descriptor(const std::filesystem::path& path, int flags);
  /// `name` in the open folder `folder`, wherever that has been moved to.
  Descriptor(const Descriptor& folder, const std::filesystem::path& name, int flags);
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();

  int number() const { return number_; }
  FileVersion version() const;
  /// Locks the file as HDF5 does, as long as it is open; false when another program has it open under a lock
  /// that is in the way.
  bool lock_for_writing();
  bool lock_for_reading();
  void write(std::string_view text);
  /// Writes all that `source` still has to read.
  void write_all_of(const Descriptor& source);
  /// Writes a part of `source` to the same place.
  void write_part_of(const Descriptor& source, const ByteRange& part);
  void truncate(std::uint64_t bytes);
  /// Forces what was written to disk.
  void sync();
  void close();

 private:
  [[noreturn]] void fail(std::string_view action, int reason) const;

  std::filesystem::path path_;
  int number_;
};

/// Locks an open file for writing (exclusively) or for reading, where the file system has locks. False when
/// somebody else's lock is in the way.
bool lock_file(int descriptor, bool exclusive);

/// Throws FileError "PATH: cannot ACTION: what the system calls `reason`". reason: an errno.
[[noreturn]] void throw_file_error(const std::filesystem::path& path, std::string_view action, int reason);

}  // namespace vitrum::output
