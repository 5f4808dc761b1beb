#include "output/hdf5_driver.hpp"

#include <H5FDpublic.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#if H5_VERSION_GE(1, 13, 2)
#include <H5FDdevelop.h>
#endif

#include "output/hdf5_internal.hpp"

namespace vitrum::output {
namespace {

struct Info {
  FileRecord* record;
};

struct Unwritten {
  haddr_t begin;
  std::vector<unsigned char> bytes;
};

/// An open file, as HDF5's drivers have it: their common part first.
struct OpenFile : H5FD_t {
  int descriptor = -1;
  FileRecord* record = nullptr;
  dev_t device = 0;
  ino_t inode = 0;
  haddr_t allocated = 0, length = 0;
  std::vector<Unwritten> unwritten;  ///< in the order in which it should have been written

  void note(int reason) {
    if (record->failure == 0) record->failure = reason;
  }
  void note_written(const ByteRange& range) {
    try {
      record->written.push_back(range);
    } catch (const std::bad_alloc&) {
      note(ENOMEM);
    }
  }
};

OpenFile& of(H5FD_t* file) {
  return *static_cast<OpenFile*>(file);
}
const OpenFile& of(const H5FD_t* file) {
  return *static_cast<const OpenFile*>(file);
}

/// Calls a system function again when a signal has interrupted it.
template <class Call>
auto uninterrupted(Call&& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// Tells HDF5 why the system has refused; errno says it.
void push_reason(hid_t kind) {
  H5Epush2(H5E_DEFAULT, __FILE__, __func__, __LINE__, H5E_ERR_CLS, H5E_VFL, kind, "%s", std::strerror(errno));
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t access, haddr_t) {
  const int how = O_CLOEXEC | (flags & H5F_ACC_RDWR ? O_RDWR : O_RDONLY) |
                  (flags & H5F_ACC_TRUNC ? O_TRUNC : 0) | (flags & H5F_ACC_CREAT ? O_CREAT : 0) |
                  (flags & H5F_ACC_EXCL ? O_EXCL : 0);
  struct stat status {};
  const int descriptor = uninterrupted([&] { return ::open(name, how, 0666); });
  if (descriptor < 0 || fstat(descriptor, &status) != 0) {
    push_reason(H5E_CANTOPENFILE);
    if (descriptor >= 0) ::close(descriptor);
    return nullptr;
  }
  auto* file = new (std::nothrow) OpenFile;
  if (file == nullptr) {
    ::close(descriptor);
    return nullptr;
  }
  file->descriptor = descriptor;
  file->record = static_cast<const Info*>(H5Pget_driver_info(access))->record;
  file->device = status.st_dev, file->inode = status.st_ino;
  file->length = static_cast<haddr_t>(status.st_size);
  return file;
}

herr_t close_file(H5FD_t* file) {
  const std::unique_ptr<OpenFile> closing(&of(file));
  if (::close(closing->descriptor) != 0) closing->note(errno);
  return 0;
}

int compare_files(const H5FD_t* one, const H5FD_t* other) {
  const OpenFile &a = of(one), &b = of(other);
  if (a.device != b.device) return a.device < b.device ? -1 : 1;
  if (a.inode != b.inode) return a.inode < b.inode ? -1 : 1;
  return 0;
}

/// As HDF5's own driver of plain files.
herr_t query_features(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_POSIX_COMPAT_HANDLE | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t allocated_end(const H5FD_t* file, H5FD_mem_t) {
  return of(file).allocated;
}

herr_t set_allocated_end(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  of(file).allocated = end;
  return 0;
}

haddr_t file_end(const H5FD_t* file, H5FD_mem_t) {
  return of(file).length;
}

herr_t system_handle(H5FD_t* file, hid_t, void** handle) {
  *handle = &of(file).descriptor;
  return 0;
}

/// Lays the part of `piece` that belongs to [begin, begin + size) over what was read from there.
void overlay(const Unwritten& piece, haddr_t begin, std::size_t size, unsigned char* bytes) {
  const haddr_t first = std::max(begin, piece.begin),
                last = std::min<haddr_t>(begin + size, piece.begin + piece.bytes.size());
  if (first < last)
    std::memcpy(bytes + (first - begin), piece.bytes.data() + (first - piece.begin), last - first);
}

herr_t read_bytes(H5FD_t* opened, H5FD_mem_t, hid_t, haddr_t begin, std::size_t size, void* buffer) {
  const OpenFile& file = of(opened);
  auto* bytes = static_cast<unsigned char*>(buffer);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = uninterrupted(
        [&] { return pread(file.descriptor, bytes + done, size - done, static_cast<off_t>(begin + done)); });
    if (count < 0) {
      push_reason(H5E_READERROR);
      return -1;
    }
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  std::memset(bytes + done, 0, size - done);  // beyond the end of the file
  for (const Unwritten& piece : file.unwritten) overlay(piece, begin, size, bytes);
  return 0;
}

/// Bytes that reached the file; fewer than `size` where it can take no more (errno says why).
std::size_t write_what_fits(int descriptor, haddr_t begin, std::size_t size, const unsigned char* bytes) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = uninterrupted(
        [&] { return pwrite(descriptor, bytes + done, size - done, static_cast<off_t>(begin + done)); });
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

herr_t write_bytes(H5FD_t* opened, H5FD_mem_t, hid_t, haddr_t begin, std::size_t size, const void* buffer) {
  OpenFile& file = of(opened);
  const auto* bytes = static_cast<const unsigned char*>(buffer);
  file.length = std::max<haddr_t>(file.length, begin + size);
  // After a failure nothing goes to the file any more: a later write must not lie below an earlier one.
  const std::size_t done =
      file.record->failure == 0 ? write_what_fits(file.descriptor, begin, size, bytes) : 0;
  if (done == size) {
    file.note_written({begin, size});
    return 0;
  }
  file.note(errno);
  try {
    file.unwritten.push_back({begin + done, {bytes + done, bytes + size}});
  } catch (const std::bad_alloc&) {
    return -1;  // the exception must not pass through HDF5
  }
  return 0;
}

herr_t truncate_file(H5FD_t* opened, hid_t, hbool_t) {
  OpenFile& file = of(opened);
  if (file.length == file.allocated) return 0;
  if (file.record->failure == 0 &&
      uninterrupted([&] { return ftruncate(file.descriptor, static_cast<off_t>(file.allocated)); }) != 0)
    file.note(errno);
  file.length = file.allocated;
  return 0;
}

/// Locks where the file system can, does without where it cannot.
herr_t lock_opened(H5FD_t* file, hbool_t exclusive) {
  if (lock_file(of(file).descriptor, exclusive)) return 0;
  push_reason(H5E_CANTLOCKFILE);
  return -1;
}

herr_t unlock_opened(H5FD_t* file) {
  (void)flock(of(file).descriptor, LOCK_UN);
  return 0;
}

H5FD_class_t make_class() {
  H5FD_class_t c{};
#if H5_VERSION_GE(1, 13, 2)
  c.version = H5FD_CLASS_VERSION;
  c.value = 512;  // any that HDF5 does not keep for itself
#endif
  c.name = "vitrum";
  c.maxaddr = static_cast<haddr_t>(std::numeric_limits<off_t>::max());
  c.fc_degree = H5F_CLOSE_WEAK;
  c.fapl_size = sizeof(Info);
  c.open = open_file;
  c.close = close_file;
  c.cmp = compare_files;
  c.query = query_features;
  c.get_eoa = allocated_end;
  c.set_eoa = set_allocated_end;
  c.get_eof = file_end;
  c.get_handle = system_handle;
  c.read = read_bytes;
  c.write = write_bytes;
  c.truncate = truncate_file;
  c.lock = lock_opened;
  c.unlock = unlock_opened;
  const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), c.fl_map);
  return c;
}

}  // namespace

Handle file_properties(FileRecord& record, const std::string& where) {
  static const H5FD_class_t driver_class = make_class();
  static const hid_t driver = checked(H5FDregister(&driver_class), where, "register the file driver");
  Handle access = own(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, where, "set file access");
  const Info info{&record};
  checked(H5Pset_driver(access.id(), driver, &info), where, "set the file driver");
  return access;
}

}  // namespace vitrum::output
