#pragma once
#include <filesystem>

namespace vitrum::app {

/// Seconds since this process has started.
double process_seconds();

/// Bytes of memory that this process can still have: what the machine has left, and less where a limit on the
/// process (ulimit -v) or its control group says so.
double available_memory();

/// Bytes that can still be written into a folder, which need not exist yet; infinite where the file system
/// does not tell.
double available_disk(const std::filesystem::path& folder);

}  // namespace vitrum::app
