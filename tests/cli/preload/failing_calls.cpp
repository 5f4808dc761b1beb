// Preloaded before the C library: lets one call that writes to a file system fail, or kills the process amid
// it.
//   FAULT_CALL=N      the N-th such call of main, from 1; standard streams do not count
//   FAULT_NAME=NAME   only calls of this name count
//   FAULT=KILL        kill -9; a write is done by half before
//   FAULT=STALL       the call takes for ever; standard error tells when it begins
//   FAULT=NUMBER      the call fails with this errno
//   FAULT_LASTS=1     so do all later calls that take space
//   FAULT_LOG=FILE    the names of all such calls, a line each, are left there at the end
//   LOCKS_FAIL=NUMBER every flock fails with this errno, as on file systems that have no locks
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

const char* setting(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

const long chosen = std::atol(setting("FAULT_CALL", "0"));
const std::string fault = setting("FAULT", ""), only = setting("FAULT_NAME", "");
const bool kills = fault == "KILL", stalls = fault == "STALL", lasts = *setting("FAULT_LASTS", "") != '\0';
const int reason = std::atoi(fault.c_str());
std::atomic<long> calls = 0;

// What libraries do before main is not the program's.
std::atomic<bool> in_main = false;
using Main = int (*)(int, char**, char**);
Main program_main = nullptr;

int observed_main(int argc, char** argv, char** environment) {
  in_main = true;
  return program_main(argc, argv, environment);
}

/// Names of the calls so far; leaves them in FAULT_LOG when the process ends.
struct Log {
  std::string names;
  ~Log() {
    if (std::FILE* file = std::fopen(setting("FAULT_LOG", "/dev/null"), "w")) std::fputs(names.c_str(), file);
  }
} log_;

[[noreturn]] void wait_for_ever() {
  for (;;) pause();
}

/// Counts a call; whether it is to fail, with errno set. amid: what to do before the process is killed.
template <class Amid>
bool fails(const char* name, bool takes_space, Amid&& amid) {
  if (!in_main || (!only.empty() && only != name)) return false;
  const long call = ++calls;
  log_.names.append(name).append("\n");
  if (chosen == 0 || call < chosen || (call > chosen && !(lasts && takes_space))) return false;
  if (kills) {
    amid();
    kill(getpid(), SIGKILL);
  }
  if (stalls) std::fputs("stalled\n", stderr);
  if (kills || stalls) wait_for_ever();
  errno = reason;
  return true;
}
bool fails(const char* name, bool takes_space) {
  return fails(name, takes_space, [] {});
}

template <class Function>
Function following(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool writes(int flags) {
  return (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0;
}

mode_t mode_argument(int flags, va_list list) {
  return (flags & O_CREAT) != 0 ? va_arg(list, mode_t) : 0;
}

}  // namespace

// `real` is the function that stands behind.
#define REAL(name) static const auto real = following<decltype(&name)>(#name)

extern "C" int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                                 void (*end)(), void* stack) {
  REAL(__libc_start_main);
  program_main = main;
  return real(observed_main, argc, argv, init, fini, end, stack);
}

#define OPEN(name)                                                                                \
  extern "C" int name(const char* path, int flags, ...) {                                         \
    REAL(name);                                                                                   \
    va_list list;                                                                                 \
    va_start(list, flags);                                                                        \
    const mode_t mode = mode_argument(flags, list);                                               \
    va_end(list);                                                                                 \
    return writes(flags) && fails("open", (flags & O_CREAT) != 0) ? -1 : real(path, flags, mode); \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                                                                      \
  extern "C" int name(int folder, const char* path, int flags, ...) {                                     \
    REAL(name);                                                                                           \
    va_list list;                                                                                         \
    va_start(list, flags);                                                                                \
    const mode_t mode = mode_argument(flags, list);                                                       \
    va_end(list);                                                                                         \
    return writes(flags) && fails("open", (flags & O_CREAT) != 0) ? -1 : real(folder, path, flags, mode); \
  }
OPENAT(openat)
OPENAT(openat64)

extern "C" ssize_t write(int file, const void* bytes, size_t size) {
  REAL(write);
  if (file > 2 && fails("write", true, [&] { (void)!real(file, bytes, size / 2); })) return -1;
  return real(file, bytes, size);
}

#define PWRITE(name)                                                                           \
  extern "C" ssize_t name(int file, const void* bytes, size_t size, off_t offset) {            \
    REAL(name);                                                                                \
    if (fails("pwrite", true, [&] { (void)!real(file, bytes, size / 2, offset); })) return -1; \
    return real(file, bytes, size, offset);                                                    \
  }
PWRITE(pwrite)
PWRITE(pwrite64)

#define FTRUNCATE(name)                                       \
  extern "C" int name(int file, off_t size) noexcept {        \
    REAL(name);                                               \
    return fails("ftruncate", false) ? -1 : real(file, size); \
  }
FTRUNCATE(ftruncate)
FTRUNCATE(ftruncate64)

extern "C" int fsync(int file) {
  REAL(fsync);
  return fails("fsync", true) ? -1 : real(file);
}

extern "C" int syncfs(int file) noexcept {
  REAL(syncfs);
  return fails("syncfs", true) ? -1 : real(file);
}

extern "C" int rename(const char* from, const char* to) noexcept {
  REAL(rename);
  return fails("rename", false) ? -1 : real(from, to);
}

extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to,
                         unsigned flags) noexcept {
  REAL(renameat2);
  return fails("renameat2", false) ? -1 : real(from_folder, from, to_folder, to, flags);
}

extern "C" int remove(const char* path) noexcept {
  REAL(remove);
  return fails("remove", false) ? -1 : real(path);
}

extern "C" int mkdir(const char* path, mode_t mode) noexcept {
  REAL(mkdir);
  return fails("mkdir", true) ? -1 : real(path, mode);
}

extern "C" int flock(int file, int operation) noexcept {
  static const int refusal = std::atoi(setting("LOCKS_FAIL", "0"));
  REAL(flock);
  if (refusal == 0) return real(file, operation);
  errno = refusal;
  return -1;
}
