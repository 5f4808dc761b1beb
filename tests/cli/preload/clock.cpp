// Preloaded before the C library: a wall clock that shows CLOCK_BASE (s since 1970), and with CLOCK_JUMP (s)
// is set forward and back by that much at every look. Clocks that measure durations stay as they are.
#include <dlfcn.h>
#include <sys/time.h>

#include <atomic>
#include <cstdlib>
#include <ctime>

namespace {

long long setting(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? std::atoll(value) : 0;
}

bool wanted() {
  static const bool wanted = std::getenv("CLOCK_BASE") != nullptr;
  return wanted;
}

std::time_t shown() {
  static const long long base = setting("CLOCK_BASE"), jump = setting("CLOCK_JUMP");
  static std::atomic<int> looks = 0;
  return static_cast<std::time_t>(base + (++looks % 2 == 0 ? jump : -jump));
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  static const auto real = reinterpret_cast<decltype(&clock_gettime)>(dlsym(RTLD_NEXT, "clock_gettime"));
  if (!wanted() || clock != CLOCK_REALTIME) return real(clock, time);
  *time = {shown(), 0};
  return 0;
}

extern "C" std::time_t time(std::time_t* stored) noexcept {
  static const auto real = reinterpret_cast<decltype(&time)>(dlsym(RTLD_NEXT, "time"));
  if (!wanted()) return real(stored);
  const std::time_t now = shown();
  if (stored != nullptr) *stored = now;
  return now;
}

extern "C" int gettimeofday(timeval* time, void* zone) noexcept {
  static const auto real = reinterpret_cast<int (*)(timeval*, void*)>(dlsym(RTLD_NEXT, "gettimeofday"));
  if (!wanted()) return real(time, zone);
  *time = {shown(), 0};
  return 0;
}
