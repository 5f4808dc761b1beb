#include "app/machine.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>

namespace vitrum::app {
namespace {

/// Set before main() begins.
const std::chrono::steady_clock::time_point process_start = std::chrono::steady_clock::now();

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// MemAvailable: free, or given back by caches when asked for.
double left_on_machine() {
  std::ifstream file("/proc/meminfo");
  std::string name, unit;
  double kilobytes = 0.0;
  while (file >> name >> kilobytes && std::getline(file, unit))
    if (name == "MemAvailable:") return 1024.0 * kilobytes;
  return unlimited;
}

double left_of_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  double pages = 0.0;
  std::ifstream("/proc/self/statm") >> pages;  // of address space in use
  return std::max(0.0,
                  static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE)));
}

/// "max" where the group has no limit.
double limit_of_group() {
  double bytes = unlimited;
  std::ifstream file("/sys/fs/cgroup/memory.max");
  return file >> bytes ? bytes : unlimited;
}

}  // namespace

double process_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - process_start).count();
}

double available_memory() {
  return std::min({left_on_machine(), left_of_limit(), limit_of_group()});
}

double available_disk(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::path existing = std::filesystem::absolute(folder, failure);
  while (!std::filesystem::exists(existing, failure) && existing.has_relative_path())
    existing = existing.parent_path();
  const std::filesystem::space_info space = std::filesystem::space(existing, failure);
  return failure ? unlimited : static_cast<double>(space.available);
}

}  // namespace vitrum::app
