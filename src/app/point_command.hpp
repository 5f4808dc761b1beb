#pragma once
#include <string>
#include <vector>

namespace vitrum::app {

struct PointOptions {
  std::string file;
  std::vector<std::string> overrides;
  std::string out;  ///< empty: standard output
};

/// `vitrum point`: drives one material point along a strain path; CSV rows out, events on standard error.
int drive_point(const PointOptions& options);

}  // namespace vitrum::app
