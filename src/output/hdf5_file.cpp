#include <fmt/format.h>

#include <atomic>
#include <new>

#include "output/hdf5_image.hpp"
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

hid_t refuse_to_follow(const char*, hid_t, const void*, std::size_t, hid_t, hid_t) {
  H5Epush2(H5E_DEFAULT, __FILE__, __func__, __LINE__, H5E_ERR_CLS, H5E_LINK, H5E_TRAVERSE,
           "it leads into another file");
  return H5I_INVALID_HID;
}

/// A file must not lead this program into other files: links to files are written, for others, and never
/// followed. Who reads an output here opens its file by name.
bool follow_no_links() {
  H5L_class_t links{};
  links.version = H5L_LINK_CLASS_T_VERS;
  links.id = H5L_TYPE_EXTERNAL;
  links.comment = "link to a file";
  links.trav_func = refuse_to_follow;
  return H5Lregister(&links) >= 0;
}

/// HDF5 prints its error stack by default; here it goes into exceptions. (The setting belongs to the calling
/// thread.) What HDF5 left open when memory ran out, it cannot close at the end.
void set_up() {
  require_spare_memory();
  static const bool closes_at_exit = H5dont_atexit() < 0;
  static_cast<void>(closes_at_exit);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  static const bool closed = follow_no_links();
  if (!closed) throw Hdf5Error("HDF5 cannot be kept from following links into other files");
}

/// With the properties that all files have.
Handle completed(Handle access, const std::string& path) {
  checked(H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG), path, "set file access");
  checked(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110), path, "set file format");
  return access;
}

/// The image of a file is found by its superblock, whose form differs between versions.
void require_own_format(const std::string& bytes, const std::string& path) {
  if (!bytes.starts_with("\x89HDF\r\n\x1a\n\x03"))
    throw Hdf5Error(fmt::format("{}: is not of the HDF5 1.10 format, in which it was written", path));
}

/// HDF5 takes files in memory of one name for one file.
std::string unique_name() {
  static std::atomic<std::uint64_t> count = 0;
  return fmt::format("file {} in memory", ++count);
}

}  // namespace

void throw_hdf5_error(const std::string& where, const std::string& action) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &reason);
  H5Eclear2(H5E_DEFAULT);
  throw Hdf5Error(scene::single_line(
      fmt::format("{}: cannot {}: {}", where, action, reason.empty() ? "unknown HDF5 error" : reason)));
}

File::File(const std::filesystem::path& path, std::unique_ptr<FileImage> image, std::size_t user_block,
           Handle handle)
    : path_(path),
      image_(std::move(image)),
      user_block_(user_block),
      handle_(std::move(handle)),
      root_(own(H5Gopen2(handle_.id(), "/", H5P_DEFAULT), H5Gclose, path_, "open the root group"),
            path_ + ": /") {}

File::~File() = default;
File::File(File&&) noexcept = default;

File File::create(const std::filesystem::path& path, std::size_t user_block) {
  set_up();
  const std::string name = path.string();
  const Handle creation = own(H5Pcreate(H5P_FILE_CREATE), H5Pclose, name, "set file creation");
  if (user_block > 0) checked(H5Pset_userblock(creation.id(), user_block), name, "set the user block");
  auto image = std::make_unique<FileImage>();
  const Handle access = completed(image->properties(name), name);
  return File(path, std::move(image), user_block,
              own(H5Fcreate(unique_name().c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose, name,
                  "create the file"));
}

File File::open_image(const std::filesystem::path& path, std::string& bytes) {
  set_up();
  const std::string name = path.string();
  require_own_format(bytes, name);
  auto image = std::make_unique<FileImage>();
  const Handle access = completed(image->properties(name), name);
  checked(H5Pset_file_image(access.id(), bytes.data(), bytes.size()), name, "read the file");
  return File(path, std::move(image), 0,
              own(H5Fopen(unique_name().c_str(), H5F_ACC_RDWR, access.id()), H5Fclose, name,
                  "open the file as HDF5"));
}

File File::open_to_read(const std::filesystem::path& path) {
  set_up();
  require_regular_file(path);
  const std::string name = path.string();
  const Handle access = completed(own(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, name, "set file access"), name);
  // What is read was put in place as a whole; a lock would guard nothing, and some file systems have none.
  checked(H5Pset_file_locking(access.id(), false, true), name, "set file locking");
  return File(
      path, nullptr, 0,
      own(H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose, name, "open the file as HDF5"));
}

std::span<char> File::close() {
  root_ = Group(Handle(), path_ + ": /");
  if (!handle_.release()) throw_hdf5_error(path_, "close the file");
  return image_->bytes(user_block_);
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace vitrum::output
