#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "output/hdf5_driver.hpp"
#include "output/hdf5_internal.hpp"
#include "output/regular_file.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::output {
namespace {

herr_t keep_innermost(unsigned depth, const H5E_error2_t* error, void* text) {
  try {
    if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  } catch (const std::bad_alloc&) {
    return -1;  // no exception may cross HDF5
  }
  return 0;
}

/// Makes sure that HDF5 will find memory: where it does not, HDF5 1.10 crashes in its own handling of errors.
/// Throws std::bad_alloc.
void require_spare_memory() {
  constexpr std::size_t enough = std::size_t{32}
                                 << 20;  // its caches and buffers, of which it has a few of 1 MB
  ::operator delete(::operator new(enough));
}

/// HDF5 prints its error stack by default; here it goes into exceptions. (The setting belongs to the calling
/// thread.) A file must not lead into other files. And what HDF5 left open when memory ran out, it cannot
/// close at the end.
void set_up() {
  require_spare_memory();
  static const bool closes_at_exit = H5dont_atexit() < 0;
  static_cast<void>(closes_at_exit);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  if (H5Lis_registered(H5L_TYPE_EXTERNAL) > 0) H5Lunregister(H5L_TYPE_EXTERNAL);
}

Handle access_properties(FileRecord& record, const std::string& path) {
  Handle access = file_properties(record, path);
  checked(H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG), path, "set file access");
  checked(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110), path, "set file format");
  checked(H5Pset_file_locking(access.id(), true, true), path, "set file locking");
  return access;
}

/// Ranges by rising place; those that overlap or adjoin become one.
std::vector<ByteRange> joined(std::vector<ByteRange> ranges) {
  std::sort(ranges.begin(), ranges.end(),
            [](const ByteRange& a, const ByteRange& b) { return a.begin < b.begin; });
  std::size_t count = 0;
  for (const ByteRange& next : ranges) {
    ByteRange* last = count == 0 ? nullptr : &ranges[count - 1];
    if (last != nullptr && next.begin <= last->begin + last->size)
      last->size = std::max(last->size, next.begin + next.size - last->begin);
    else
      ranges[count++] = next;
  }
  ranges.resize(count);
  return ranges;
}

}  // namespace

void throw_hdf5_error(const std::string& where, const std::string& action) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &reason);
  H5Eclear2(H5E_DEFAULT);
  throw Hdf5Error(scene::single_line(
      fmt::format("{}: cannot {}: {}", where, action, reason.empty() ? "unknown HDF5 error" : reason)));
}

File::File(const std::filesystem::path& path, std::unique_ptr<FileRecord> record, Handle handle)
    : path_(path),
      record_(std::move(record)),
      handle_(std::move(handle)),
      root_(own(H5Gopen2(handle_.id(), "/", H5P_DEFAULT), H5Gclose, path_, "open the root group"),
            path_ + ": /") {}

File::~File() = default;
File::File(File&&) noexcept = default;

File File::create(const std::filesystem::path& path, std::uint64_t user_block) {
  set_up();
  const std::string name = path.string();
  const Handle creation = own(H5Pcreate(H5P_FILE_CREATE), H5Pclose, name, "set file creation");
  if (user_block > 0) checked(H5Pset_userblock(creation.id(), user_block), name, "set the user block");
  auto record = std::make_unique<FileRecord>();
  const Handle access = access_properties(*record, name);
  return File(path, std::move(record),
              own(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose, name,
                  "create the file"));
}

File File::open_to_read(const std::filesystem::path& path) {
  return open(path, H5F_ACC_RDONLY, "open the file as HDF5");
}

File File::open_to_write(const std::filesystem::path& path) {
  return open(path, H5F_ACC_RDWR, "open the file as HDF5 for writing");
}

File File::open(const std::filesystem::path& path, unsigned flags, const std::string& action) {
  set_up();
  require_regular_file(path);
  const std::string name = path.string();
  auto record = std::make_unique<FileRecord>();
  const Handle access = access_properties(*record, name);
  return File(path, std::move(record),
              own(H5Fopen(name.c_str(), flags, access.id()), H5Fclose, name, action));
}

std::vector<ByteRange> File::close() {
  root_ = Group(Handle(), path_ + ": /");
  if (!handle_.release()) throw_hdf5_error(path_, "close the file");
  if (record_->failure != 0)
    throw Hdf5Error(fmt::format("{}: cannot write the file: {}", path_, std::strerror(record_->failure)));
  return joined(std::move(record_->written));
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace vitrum::output
