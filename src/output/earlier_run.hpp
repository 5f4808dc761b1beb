#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace vitrum::output {

/// What an earlier run left in `folder` that is worth keeping, in words; empty: nothing. Worth keeping are a
/// checkpoint, a result with at least one output, and a summary unless it tells of a failure; also files
/// under these names, and under that of energy.csv, whose content is not a run's. So a run that was killed or
/// failed before its first output leaves nothing worth keeping.
std::vector<std::string> traces_of_run(const std::filesystem::path& folder);

/// Removes every file that a run writes, whole ones and those in the making. Throws FileError.
void remove_run(const std::filesystem::path& folder);

/// Removes the files in the making that a killed run left.
void remove_unfinished(const std::filesystem::path& folder);

}  // namespace vitrum::output
