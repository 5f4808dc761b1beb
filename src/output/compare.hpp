#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vitrum::output {

/// A number that both results give, by its dotted name in summary.json; absent where a result says null.
struct QuantityDifference {
  std::string name;
  std::optional<double> a, b;
};

/// How far a field of B lies from that of A at a common time. A component that is NaN in both is equal; in
/// one only, it counts in `only_one` and not in the norms.
struct FieldDifference {
  std::string name, unit;
  double largest = 0.0;      ///< largest absolute difference of a component, in the field's unit
  std::size_t particle = 0;  ///< where
  double relative =
      0.0;  ///< Euclidean norm of B - A over that of A; infinite where A vanishes and B does not
  std::size_t only_one = 0;  ///< components that are a number in one result only
};

struct TimeDifference {
  double time = 0.0;  ///< s
  std::vector<FieldDifference> fields;
};

/// Differences between two results.
struct Comparison {
  std::vector<QuantityDifference>
      quantities;  ///< energy, failure and bodies of the summaries; empty without two summaries
  std::vector<TimeDifference> times;  ///< outputs that both have
  std::size_t outputs_a = 0, outputs_b = 0;
  std::string remark;  ///< why fields were not compared; empty when they were
};

/// Compares two results, each a result.h5 or the folder of a run. Times within 1e-9 of A's span are one.
/// Throws FileError.
Comparison compare_results(const std::filesystem::path& a, const std::filesystem::path& b);

/// What `vitrum compare` prints; ends with a newline.
std::string comparison_text(const Comparison& comparison, bool json);

}  // namespace vitrum::output
