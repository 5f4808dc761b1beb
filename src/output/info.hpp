#pragma once
#include <filesystem>
#include <string>

namespace vitrum::output {

/// What `vitrum info` prints about a result file, or a run's directory (then with the status of its
/// summary.json): title, provenance, scene digest, outputs with their times, fields with units, particles per
/// body, last values of the series. json: the same as a JSON object. Ends with a newline. Throws FileError.
std::string describe_result(const std::filesystem::path& path, bool json);

}  // namespace vitrum::output
