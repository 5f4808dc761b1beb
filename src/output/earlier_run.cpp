#include "output/earlier_run.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <utility>

#include "observe/registry.hpp"
#include "output/atomic_file.hpp"
#include "output/json_file.hpp"
#include "output/result_file.hpp"
#include "output/result_reader.hpp"
#include "scene/input_error.hpp"

namespace vitrum::output {
namespace {

// The checkpoint first: of a run that is removed in part only, nothing shall be resumed.
constexpr std::array files = {"checkpoint.h5", "result.xdmf", "summary.json", "failed_point.toml",
                              "result.h5"};

/// The files of the tables that runs have.
std::vector<std::pair<std::string, TableInfo>> table_files() {
  std::vector<std::pair<std::string, TableInfo>> list;
  for (const ObserverKind& kind : observer_kinds())
    if (kind.table != nullptr) list.emplace_back(fmt::format("{}.csv", kind.table->name), *kind.table);
  return list;
}

bool present(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::exists(file, error);
}

/// result.h5 in words, unless it is a result without an output.
std::string result_trace(const std::filesystem::path& file) {
  try {
    const std::size_t outputs = ResultReader(file).steps().size();
    return outputs == 0 ? "" : fmt::format("result.h5 with {} output{}", outputs, outputs == 1 ? "" : "s");
  } catch (const FileError&) {
    return "result.h5, which cannot be read as a result";
  }
}

/// summary.json in words, unless it tells of a failure.
std::string summary_trace(const std::filesystem::path& file) {
  try {
    const std::optional<nlohmann::ordered_json> summary = read_json_object(file);
    return !summary || summary->value("status", nlohmann::ordered_json()) == "failed" ? "" : "summary.json";
  } catch (const FileError&) {
    return "summary.json, which is not a run's";
  }
}

/// A table's file in words, if no run wrote it.
std::string foreign_table(const std::filesystem::path& path, const TableInfo& kind) {
  // The columns of places are named by the geometry.
  const std::string begin = header({kind.name, kind.description, kind.columns.first(2)});
  std::error_code error;
  std::string line;
  if (std::filesystem::is_regular_file(path, error)) std::getline(std::ifstream(path), line);
  return line.starts_with(begin) ? "" : path.filename().string() + ", which is not a run's";
}

}  // namespace

std::vector<std::string> traces_of_run(const std::filesystem::path& folder) {
  std::vector<std::string> traces;
  const auto look = [&](const std::string& name, const auto& trace) {
    if (!present(folder / name)) return;
    if (const std::string text = trace(folder / name); !text.empty()) traces.push_back(text);
  };
  look("result.h5", result_trace);
  if (!present(result_path(folder)) && has_outputs(folder)) traces.emplace_back("outputs in steps/");
  look("checkpoint.h5", [](const std::filesystem::path&) { return std::string("checkpoint.h5"); });
  look("summary.json", summary_trace);
  for (const auto& [name, kind] : table_files())
    look(name, [&](const std::filesystem::path& file) { return foreign_table(file, kind); });
  return traces;
}

void remove_run(const std::filesystem::path& folder) {
  for (const char* name : files) remove_file(folder / name);
  for (const auto& [name, kind] : table_files()) remove_file(folder / name);
  remove_outputs(folder, 0);
  remove_file(particles_path(folder));
  remove_unfinished(folder);
  std::error_code not_empty;
  std::filesystem::remove(steps_path(folder), not_empty);
}

void remove_unfinished(const std::filesystem::path& folder) {
  for (const char* name : files) remove_file(next_of(folder / name));
  for (const auto& [name, kind] : table_files()) remove_file(next_of(folder / name));
  remove_file(next_of(particles_path(folder)));
}

}  // namespace vitrum::output
