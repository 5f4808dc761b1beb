#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vitrum::output {

/// A number that both results give, by its dotted name in summary.json; absent where a result says null.
struct QuantityDifference {
  std::string name, unit;
  std::optional<double> a, b;
  double scale;  ///< what the difference is measured by: the larger of the two, or more (QuantityScales)

  /// Infinite where one result alone says something.
  double relative() const;
};

/// How far a field of B lies from that of A at a common time. A component that is NaN in both is equal; in
/// one only, it counts in `only_one` and not in the norms.
struct FieldDifference {
  std::string name, unit;
  double largest = 0.0;      ///< largest absolute difference of a component, in the field's unit
  std::size_t particle = 0;  ///< where
  double rms = 0.0;          ///< root of the mean square difference of the components, in the field's unit
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
  std::string a, b;  ///< the results' files
  std::vector<QuantityDifference>
      quantities;  ///< energy, failure, bodies and contacts of the summaries; empty without two summaries
  std::vector<TimeDifference> times;  ///< outputs that both have
  std::size_t outputs_a = 0, outputs_b = 0;
  std::string remark;           ///< why fields were not compared; empty when they were
  bool without_fields = false;  ///< a result has none (--no-fields)
};

struct ComparisonOptions {
  bool last = false;                ///< only the last output that both have
  std::vector<std::string> fields;  ///< only these; none: all that both have
};

/// Compares two results, each a result.h5 or the folder of a run. Throws FileError, and InputError for a
/// field that neither has.
Comparison compare_results(const std::filesystem::path& a, const std::filesystem::path& b,
                           const ComparisonOptions& options = {});

/// Pairs (i, j) of outputs whose times are one but for rounding: within some last digits, or a millionth of
/// the shortest interval between outputs. Times rise.
std::vector<std::pair<std::size_t, std::size_t>> common_times(std::span<const double> a,
                                                              std::span<const double> b);

/// Whether the results are further apart than `tolerance`: the relative difference of a field at any of the
/// times, or values that one result has alone. Where a result has no fields, the relative difference of a
/// quantity. Results that have fields of which none can be compared differ.
bool differ(const Comparison& comparison, double tolerance);

/// What `vitrum compare` prints: a page for each comparison of A with another result, or JSON; ends with a
/// newline.
std::string comparison_text(std::span<const Comparison> comparisons, bool json);

}  // namespace vitrum::output
