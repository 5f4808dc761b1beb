#pragma once
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace vitrum::output {

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
  std::uint64_t size() const;
  void write(std::string_view text);
  void truncate(std::uint64_t bytes);
  /// Forces what was written to disk.
  void sync();
  /// Forces to disk all that has been written to the file system which it is on.
  void sync_file_system();
  void close();

 private:
  [[noreturn]] void fail(std::string_view action, int reason) const;

  std::filesystem::path path_;
  int number_;
};

/// Throws FileError "PATH: cannot ACTION: what the system calls `reason`". reason: an errno.
[[noreturn]] void throw_file_error(const std::filesystem::path& path, std::string_view action, int reason);

}  // namespace vitrum::output
