#pragma once
#include <hdf5.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/input_error.hpp"

namespace vitrum::output {

/// An HDF5 call failed. The message names the file, the object, what was attempted and HDF5's innermost
/// reason.
class Hdf5Error : public FileError {
 public:
  using FileError::FileError;
};

/// Owns one HDF5 identifier.
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_), std::swap(closer_, other.closer_);
    return *this;
  }
  ~Handle() { (void)release(); }

  hid_t id() const { return id_; }
  /// Closes now; false when HDF5 reports a failure.
  bool release() { return id_ < 0 || closer_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_ = -1;
  Closer closer_ = nullptr;
};

/// Shape of a stored array: rows x columns; one-dimensional data has one column.
struct Extent {
  std::size_t rows = 0, columns = 1;
  std::size_t size() const { return rows * columns; }
};

/// A group of an open file (the file must outlive it). Names are relative to the group. Every function throws
/// Hdf5Error. Text is UTF-8. All that is written carries a checksum, so that damage is an
/// error and not another value; only types that are written are read.
class Group {
 public:
  /// `label`: "FILE: /object", for messages.
  Group(Handle handle, std::string label) : handle_(std::move(handle)), label_(std::move(label)) {}

  Group create_group(const std::string& name) const;
  Group open_group(const std::string& name) const;
  bool has(const std::string& name) const;
  /// Names of the members, sorted.
  std::vector<std::string> names() const;

  /// New array, row-major; columns == 1 gives a one-dimensional array. values.size() must be a multiple of
  /// columns.
  void write(const std::string& name, std::span<const double> values, std::size_t columns = 1) const;
  void write(const std::string& name, std::span<const std::int64_t> values, std::size_t columns = 1) const;
  void write(const std::string& name, std::span<const std::uint32_t> values, std::size_t columns = 1) const;
  void write_text(const std::string& name, const std::string& text) const;
  void write_texts(const std::string& name, std::span<const std::string> texts) const;

  /// Of an array of doubles. Like all that reads arrays, refuses other types and arrays that claim more
  /// elements than the file can hold.
  Extent extent(const std::string& name) const;
  std::vector<double> read_doubles(const std::string& name) const;
  std::vector<std::uint32_t> read_indices(const std::string& name) const;
  std::string read_text(const std::string& name) const;
  std::vector<std::string> read_texts(const std::string& name) const;

  /// New extendible one-dimensional array without rows; rows that are never written read as NaN.
  void create_series(const std::string& name) const;
  /// Writes rows of such an array from `first` on, extending it when necessary.
  void write_rows(const std::string& name, std::size_t first, std::span<const double> values) const;
  /// Drops all rows of such an array but the first `rows`.
  void keep_rows(const std::string& name, std::size_t rows) const;

  /// Attributes of the member `object`; "." is the group itself. Texts are stored twice: `name` for other
  /// readers, ".name" for text_attribute.
  void set_attribute(const std::string& object, const std::string& name, const std::string& text) const;
  void set_attribute(const std::string& object, const std::string& name, double value) const;
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  double number_attribute(const std::string& object, const std::string& name) const;
  std::int64_t integer_attribute(const std::string& object, const std::string& name) const;

  /// New member that is a group of another file; `file` is relative to the folder of this one.
  void link_to_file(const std::string& name, const std::string& file, const std::string& group) const;
  /// Removes a member.
  void remove(const std::string& name) const;

  const std::string& label() const { return label_; }

 private:
  std::string member(const std::string& name) const;
  void write_attribute(const std::string& object, const std::string& name, hid_t type,
                       const void* value) const;
  Handle open_attribute(const std::string& object, const std::string& name) const;
  /// A single value of one of the `stored` types.
  void read_single(const std::string& object, const std::string& name, std::array<hid_t, 2> stored,
                   hid_t native, void* value) const;

  Handle handle_;
  std::string label_;
};

class FileImage;

/// An HDF5 file. Files are made in memory, and reach the disk as a whole: so HDF5, of which version 1.10 does
/// not survive the news that a write has failed, never writes to one. They have the HDF5 1.10 format, whose
/// metadata all carry checksums (in earlier ones the index of chunks does not).
class File {
 public:
  /// An empty file in memory. path: where it is going to be, for messages. user_block: bytes left free at
  /// the start, 0 or a power of two >= 512.
  static File create(const std::filesystem::path& path, std::size_t user_block = 0);
  /// A file in memory that begins as a copy of `bytes` (which HDF5 does not change).
  static File open_image(const std::filesystem::path& path, std::string& bytes);
  static File open_to_read(const std::filesystem::path& path);
  ~File();
  File(File&&) noexcept;

  const Group& root() const { return root_; }
  /// Closes a file in memory; its bytes as they are to stand on disk, which live as long as this object. It
  /// may not be used otherwise afterwards.
  std::span<char> close();

 private:
  File(const std::filesystem::path& path, std::unique_ptr<FileImage> image, std::size_t user_block,
       Handle handle);

  std::string path_;
  std::unique_ptr<FileImage> image_;  ///< must outlive the handle
  std::size_t user_block_;
  Handle handle_;
  Group root_;
};

/// Version of the HDF5 library in use, "1.10.8".
std::string hdf5_version();

}  // namespace vitrum::output
