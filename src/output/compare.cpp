#include "output/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "output/json_file.hpp"
#include "output/quantity_scales.hpp"
#include "output/result_reader.hpp"
#include "scene/input_error.hpp"

namespace vitrum::output {
namespace {

using Json = nlohmann::ordered_json;

/// All numbers and nulls below `node`, by dotted name, in the order of the file.
void flatten(const Json& node, const std::string& name,
             std::vector<std::pair<std::string, std::optional<double>>>& found) {
  if (node.is_object() || node.is_array()) {
    std::size_t index = 0;
    for (const auto& [key, value] : node.items())
      flatten(value, name + "." + (node.is_array() ? std::to_string(index++) : key), found);
  } else if (node.is_number()) {
    found.emplace_back(name, node.get<double>());
  } else if (node.is_null()) {
    found.emplace_back(name, std::nullopt);
  }
}

using Quantities = std::vector<std::pair<std::string, std::optional<double>>>;

Quantities quantities_of(const Json& summary) {
  Quantities found;
  for (const char* block : {"time", "energy", "failure", "bodies", "contacts"}) {
    if (!summary.contains(block)) continue;
    Json part = summary.at(block);
    if (part.is_object() && part.contains("fragments") && part["fragments"].is_object())
      part["fragments"].erase("list");
    flatten(part, block, found);
  }
  return found;
}

FieldDifference difference(const Field& a, const Field& b) {
  FieldDifference d{a.name, a.unit};
  double squares = 0.0, reference = 0.0;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double x = a.values[i], y = b.values[i];
    if (std::isnan(x) || std::isnan(y)) {
      d.only_one += std::isnan(x) != std::isnan(y);
      continue;
    }
    const double gap = std::abs(y - x);
    ++compared;
    squares += gap * gap;
    reference += x * x;
    if (gap > d.largest) d.largest = gap, d.particle = i / a.components;
  }
  if (compared > 0) d.rms = std::sqrt(squares / static_cast<double>(compared));
  d.relative = squares == 0.0 ? 0.0 : std::sqrt(squares / reference);  // infinite where A vanishes
  return d;
}

bool is_asked_for(const ComparisonOptions& options, const std::string& field) {
  return options.fields.empty() || std::ranges::find(options.fields, field) != options.fields.end();
}

TimeDifference compare_outputs(const ResultReader& a, std::size_t i, const ResultReader& b, std::size_t j,
                               const ComparisonOptions& options) {
  TimeDifference at{a.steps()[i].time, {}};
  const OutputReader first = a.output(i), second = b.output(j);
  for (const StoredField& stored : first.fields()) {
    if (!is_asked_for(options, stored.name) || !second.has(stored)) continue;
    const Field x = first.field(stored.name), y = second.field(stored.name);
    if (x.values.size() == y.values.size()) at.fields.push_back(difference(x, y));
  }
  return at;
}

std::vector<double> times_of(const ResultReader& result) {
  std::vector<double> times;
  for (const StoredStep& step : result.steps()) times.push_back(step.time);
  return times;
}

/// Why the particles of two results cannot be compared; empty: they can.
std::string obstacle(const ParticleConstants& a, const ParticleConstants& b) {
  if (a.body.empty() && b.body.empty()) return "neither result has fields (--no-fields)";
  if (a.body.empty() || b.body.empty())
    return fmt::format("{} has no fields (--no-fields): fields are not compared", a.body.empty() ? "A" : "B");
  if (a.bodies != b.bodies) return "the results have different bodies: fields are not compared";
  if (a.body != b.body) return "the bodies have different numbers of particles: fields are not compared";
  return "";
}

/// A name that was mistyped must not pass for a field without differences.
void require_fields(const ResultReader& a, const ResultReader& b, const ComparisonOptions& options) {
  std::set<std::string> known;
  for (const ResultReader* result : {&a, &b}) {
    if (result->steps().empty()) continue;
    const OutputReader last = result->output(result->steps().size() - 1);
    for (const StoredField& field : last.fields()) known.insert(field.name);
  }
  std::vector<std::string> faults;
  for (const std::string& name : options.fields)
    if (!known.contains(name))
      faults.push_back(fmt::format("--fields: found \"{}\", expected fields of the results: {}", name,
                                   fmt::join(known, ", ")));
  if (!faults.empty()) throw InputError(faults);
}

std::string energy_unit_of(const ResultReader& result) {
  for (const StoredSeries& series : result.series())
    if (series.name == "kinetic") return series.unit;
  return "J";
}

double duration_of(const ResultReader& result) {
  return result.steps().empty() ? 0.0 : result.steps().back().time - result.steps().front().time;
}

std::vector<QuantityDifference> compare_summaries(const ResultReader& a, const ResultReader& b) {
  const auto summary_of = [](const ResultReader& result) {
    return read_json_object(result.path().parent_path() / "summary.json").value_or(Json::object());
  };
  const std::array<Json, 2> summaries{summary_of(a), summary_of(b)};
  const QuantityScales scales(summaries, std::max(duration_of(a), duration_of(b)), energy_unit_of(a));
  const Quantities second = quantities_of(summaries[1]);
  const std::map<std::string, std::optional<double>> in_b(second.begin(), second.end());
  std::vector<QuantityDifference> quantities;
  for (const auto& [name, value] : quantities_of(summaries[0]))
    if (const auto other = in_b.find(name); other != in_b.end())
      quantities.push_back({name, scales.unit(name), value, other->second,
                            std::max({scales.scale(name), std::abs(value.value_or(0.0)),
                                      std::abs(other->second.value_or(0.0))})});
  return quantities;
}

double shortest_interval(std::span<const double> times) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] > times[i - 1]) shortest = std::min(shortest, times[i] - times[i - 1]);
  return shortest;
}

}  // namespace

double QuantityDifference::relative() const {
  if (a.has_value() != b.has_value()) return std::numeric_limits<double>::infinity();
  return a == b ? 0.0 : std::abs(*b - *a) / scale;
}

std::vector<std::pair<std::size_t, std::size_t>> common_times(std::span<const double> a,
                                                              std::span<const double> b) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  if (a.empty() || b.empty()) return pairs;
  const double shortest = std::min(shortest_interval(a), shortest_interval(b));
  const double scale =
      std::max({std::abs(a.front()), std::abs(a.back()), std::abs(b.front()), std::abs(b.back())});
  const double slack = std::max(8.0 * std::numeric_limits<double>::epsilon() * scale,
                                std::isfinite(shortest) ? 1e-6 * shortest : 0.0);
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size(); ++i) {
    while (j + 1 < b.size() && std::abs(b[j + 1] - a[i]) < std::abs(b[j] - a[i])) ++j;
    if (std::abs(b[j] - a[i]) <= slack) pairs.emplace_back(i, j++);
  }
  return pairs;
}

Comparison compare_results(const std::filesystem::path& path_a, const std::filesystem::path& path_b,
                           const ComparisonOptions& options) {
  const ResultReader a(path_a), b(path_b);
  Comparison result{a.path().string(), b.path().string(), {}, {}, 0, 0, {}, false};
  result.outputs_a = a.steps().size();
  result.outputs_b = b.steps().size();
  result.quantities = compare_summaries(a, b);
  const ParticleConstants first = a.constants(), second = b.constants();
  result.without_fields = first.body.empty() || second.body.empty();
  result.remark = obstacle(first, second);
  if (!result.remark.empty()) return result;
  require_fields(a, b, options);
  auto pairs = common_times(times_of(a), times_of(b));
  if (options.last && pairs.size() > 1) pairs.erase(pairs.begin(), pairs.end() - 1);
  for (const auto& [i, j] : pairs) result.times.push_back(compare_outputs(a, i, b, j, options));
  if (result.times.empty())
    result.remark = "the results have no output time in common: fields are not compared";
  return result;
}

bool differ(const Comparison& comparison, double tolerance) {
  bool fields = false;
  for (const TimeDifference& time : comparison.times)
    for (const FieldDifference& field : time.fields) {
      if (!(field.relative <= tolerance) || field.only_one > 0) return true;
      fields = true;
    }
  if (fields) return false;
  return !comparison.without_fields ||
         std::ranges::any_of(comparison.quantities, [tolerance](const QuantityDifference& q) {
           return !(q.relative() <= tolerance);
         });
}

}  // namespace vitrum::output
