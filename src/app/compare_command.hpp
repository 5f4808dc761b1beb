#pragma once
#include <optional>
#include <string>
#include <vector>

#include "output/compare.hpp"

namespace vitrum::app {

struct CompareOptions {
  std::vector<std::string> results;  ///< A, and those that it is compared with
  output::ComparisonOptions what;
  std::optional<double> tolerance;
  bool json = false;
};

/// Compares the first result with each of the others; exit_differ where one is further from it than the
/// tolerance. Throws InputError, FileError.
int compare(const CompareOptions& options);

}  // namespace vitrum::app
