#include "output/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "output/json_file.hpp"
#include "output/result_reader.hpp"

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

std::vector<std::pair<std::string, std::optional<double>>> quantities_of(
    const std::filesystem::path& directory) {
  std::vector<std::pair<std::string, std::optional<double>>> found;
  std::optional<Json> summary = read_json_object(directory / "summary.json");
  if (!summary) return found;
  for (const char* block : {"time", "energy", "failure", "bodies"}) {
    if (!summary->contains(block)) continue;
    Json& part = summary->at(block);
    if (part.is_object() && part.contains("fragments") && part["fragments"].is_object())
      part["fragments"].erase("list");
    flatten(part, block, found);
  }
  return found;
}

FieldDifference difference(const Field& a, const Field& b) {
  FieldDifference d{a.name, a.unit};
  double squares = 0.0, reference = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double x = a.values[i], y = b.values[i];
    if (std::isnan(x) || std::isnan(y)) {
      d.only_one += std::isnan(x) != std::isnan(y);
      continue;
    }
    const double gap = std::abs(y - x);
    squares += gap * gap;
    reference += x * x;
    if (gap > d.largest) d.largest = gap, d.particle = i / a.components;
  }
  d.relative = squares == 0.0 ? 0.0 : std::sqrt(squares / reference);  // infinite where A vanishes
  return d;
}

TimeDifference compare_outputs(const ResultReader& a, std::size_t i, const ResultReader& b, std::size_t j) {
  TimeDifference at{a.steps()[i].time, {}};
  const OutputReader first = a.output(i), second = b.output(j);
  for (const StoredField& stored : first.fields()) {
    if (!second.has(stored)) continue;
    const Field x = first.field(stored.name), y = second.field(stored.name);
    if (x.values.size() == y.values.size()) at.fields.push_back(difference(x, y));
  }
  return at;
}

}  // namespace

Comparison compare_results(const std::filesystem::path& path_a, const std::filesystem::path& path_b) {
  const ResultReader a(path_a), b(path_b);
  Comparison result;
  result.outputs_a = a.steps().size();
  result.outputs_b = b.steps().size();

  const auto first = quantities_of(a.path().parent_path()), second = quantities_of(b.path().parent_path());
  const std::map<std::string, std::optional<double>> in_b(second.begin(), second.end());
  for (const auto& [name, value] : first)
    if (const auto other = in_b.find(name); other != in_b.end())
      result.quantities.push_back({name, value, other->second});

  if (a.bodies() != b.bodies() || a.body_of_particle() != b.body_of_particle()) {
    result.remark = "the results have different bodies or numbers of particles: fields are not compared";
    return result;
  }
  if (a.steps().empty()) return result;
  const double slack = 1e-9 * std::max(std::abs(a.steps().front().time), std::abs(a.steps().back().time));
  for (std::size_t i = 0, j = 0; i < a.steps().size(); ++i) {
    while (j < b.steps().size() && b.steps()[j].time < a.steps()[i].time - slack) ++j;
    if (j < b.steps().size() && b.steps()[j].time <= a.steps()[i].time + slack)
      result.times.push_back(compare_outputs(a, i, b, j));
  }
  if (result.times.empty())
    result.remark = "the results have no output time in common: fields are not compared";
  return result;
}

}  // namespace vitrum::output
