#include "output/info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "observe/registry.hpp"
#include "output/json_file.hpp"
#include "output/result_reader.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::output {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json bodies_of(const ResultReader& result) {
  Json bodies = Json::object();
  const std::vector<std::string> names = result.bodies();
  std::vector<std::size_t> particles(names.size(), 0);
  for (const std::uint32_t body : result.body_of_particle()) ++particles[body];
  for (std::size_t b = 0; b < names.size(); ++b) bodies[names[b]] = particles[b];
  return bodies;
}

/// Fields of the last output.
Json fields_of(const ResultReader& result) {
  Json fields = Json::object();
  if (result.steps().empty()) return fields;
  const OutputReader last = result.output(result.steps().size() - 1);
  for (const StoredField& stored : last.fields()) {
    const Field field = last.describe_field(stored.name);
    fields[field.name] = {
        {"unit", field.unit}, {"components", field.components}, {"description", field.description}};
  }
  return fields;
}

Json series_of(const ResultReader& result) {
  Json series = Json::object();
  for (const StoredSeries& entry : result.series())
    series[entry.name] = {{"unit", entry.unit},
                          {"last", entry.values.empty() ? Json(nullptr) : number(entry.values.back())},
                          {"description", entry.description}};
  return series;
}

/// Histories and events beside the result, as far as they have been written.
Json tables_of(const ResultReader& result) {
  Json tables = Json::object();
  for (const ObserverKind& kind : observer_kinds()) {
    if (kind.table == nullptr) continue;
    const std::string file = fmt::format("{}.csv", kind.table->name);
    std::ifstream lines(result.path().parent_path() / file);
    std::size_t rows = 0;
    for (std::string line; std::getline(lines, line);) ++rows;
    if (rows == 0) continue;
    tables[std::string(kind.table->name)] = {
        {"file", file}, {"rows", rows - 1}, {"description", std::string(kind.table->description)}};
  }
  return tables;
}

/// Status and message of the summary beside the result; null where there is none (the run was killed or is
/// under way).
Json summary_of(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / "summary.json";
  const std::optional<Json> summary = read_json_object(path);
  if (!summary) return nullptr;
  if (!summary->contains("status"))
    throw FileError(fmt::format("{}: is not a summary of a run", path.string()));
  return {{"status", summary->at("status")}, {"message", summary->value("message", Json(nullptr))}};
}

Json describe(const ResultReader& result) {
  Json provenance = Json::object(), steps = Json::array();
  const Provenance stored = result.provenance();
  for (const ProvenanceEntry& entry : provenance_entries)
    provenance[std::string(entry.name)] = stored.*entry.member;
  for (const StoredStep& step : result.steps())
    steps.push_back({{"name", step.name}, {"time", number(step.time)}, {"step_index", step.step_index}});
  return {{"file", result.path().string()}, {"title", result.title()}, {"provenance", provenance},
          {"bodies", bodies_of(result)},    {"outputs", steps},        {"fields", fields_of(result)},
          {"series", series_of(result)},    {"tables", tables_of(result)}};
}

/// A text may hold anything, also what would give orders to a terminal.
std::string plain(const Json& value) {
  return value.is_string() ? scene::single_line(value.get<std::string>()) : value.dump();
}

/// How many outputs there are, over which times and steps, and how far apart.
std::string outputs_text(const Json& outputs) {
  std::string text = fmt::format("outputs ({})\n", outputs.size());
  if (outputs.empty()) return text;
  const Json &first = outputs.front(), &last = outputs.back();
  text += fmt::format("  {} .. {}  t = {} .. {} s, steps {} .. {}\n", plain(first["name"]),
                      plain(last["name"]), plain(first["time"]), plain(last["time"]),
                      plain(first["step_index"]), plain(last["step_index"]));
  double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
  for (std::size_t n = 1; n < outputs.size(); ++n) {
    if (!outputs[n]["time"].is_number() || !outputs[n - 1]["time"].is_number()) return text;
    const double interval = outputs[n]["time"].get<double>() - outputs[n - 1]["time"].get<double>();
    shortest = std::min(shortest, interval), longest = std::max(longest, interval);
  }
  if (outputs.size() > 1)
    text += longest - shortest <= 1e-6 * longest
                ? fmt::format("  every {:.6g} s\n", longest)
                : fmt::format("  {:.6g} to {:.6g} s apart\n", shortest, longest);
  return text;
}

std::string readable(const Json& info) {
  std::string text = fmt::format("title      {}\nfile       {}\n", plain(info["title"]), plain(info["file"]));
  if (info.contains("summary")) {
    const Json& summary = info["summary"];
    text += fmt::format("status     {}\n", summary.is_null() ? "no summary.json: killed, or under way"
                                                             : plain(summary["status"]));
    if (summary.is_object() && !summary["message"].is_null())
      text += fmt::format("message    {}\n", plain(summary["message"]));
  }
  for (const auto& [key, value] : info["provenance"].items())
    text += fmt::format("{:<10} {}\n", key, plain(value));
  text += "bodies\n";
  for (const auto& [name, particles] : info["bodies"].items())
    text += fmt::format("  {:<20} {} particles\n", name, plain(particles));
  text += outputs_text(info["outputs"]);
  text += "fields (last output)\n";
  for (const auto& [name, field] : info["fields"].items())
    text += fmt::format("  {:<20} {:<8} {}\n", name, plain(field["unit"]), plain(field["description"]));
  text += "series (last value)\n";
  for (const auto& [name, entry] : info["series"].items())
    text += fmt::format("  {:<24} {:>24} {:<8} {}\n", name, plain(entry["last"]), plain(entry["unit"]),
                        plain(entry["description"]));
  text += "tables (rows)\n";
  for (const auto& [name, table] : info["tables"].items())
    text += fmt::format("  {:<24} {:>24}          {}\n", plain(table["file"]), plain(table["rows"]),
                        plain(table["description"]));
  return text;
}

}  // namespace

std::string describe_result(const std::filesystem::path& path, bool json) {
  const ResultReader result(path);
  Json info = describe(result);
  if (std::filesystem::is_directory(path)) info["summary"] = summary_of(path);
  constexpr auto replace = Json::error_handler_t::replace;
  return json ? info.dump(2, ' ', false, replace) + '\n' : readable(info);
}

}  // namespace vitrum::output
