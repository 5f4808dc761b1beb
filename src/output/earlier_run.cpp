#include "output/earlier_run.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>

#include "output/atomic_file.hpp"
#include "output/energy_csv.hpp"
#include "output/json_file.hpp"
#include "output/result_file.hpp"
#include "output/result_reader.hpp"
#include "scene/input_error.hpp"

namespace vitrum::output {
namespace {

// The checkpoint first: of a run that is removed in part only, nothing shall be resumed.
constexpr std::array files = {"checkpoint.h5",     "result.xdmf", "summary.json",
                              "failed_point.toml", "energy.csv",  "result.h5"};

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

/// energy.csv in words, if no run wrote it.
std::string foreign_energy_csv(const std::filesystem::path& path) {
  std::error_code error;
  std::string line;
  if (std::filesystem::is_regular_file(path, error)) std::getline(std::ifstream(path), line);
  return line == EnergyCsv::header ? "" : "energy.csv, which is not a run's";
}

}  // namespace

std::vector<std::string> traces_of_run(const std::filesystem::path& folder) {
  std::vector<std::string> traces;
  const auto look = [&](const char* name, const auto& trace) {
    if (!present(folder / name)) return;
    if (const std::string text = trace(folder / name); !text.empty()) traces.push_back(text);
  };
  look("result.h5", result_trace);
  if (!present(result_path(folder)) && has_outputs(folder)) traces.emplace_back("outputs in steps/");
  look("checkpoint.h5", [](const std::filesystem::path&) { return std::string("checkpoint.h5"); });
  look("summary.json", summary_trace);
  look("energy.csv", foreign_energy_csv);
  return traces;
}

void remove_run(const std::filesystem::path& folder) {
  for (const char* name : files) remove_file(folder / name);
  remove_outputs(folder, 0);
  remove_file(particles_path(folder));
  remove_unfinished(folder);
  std::error_code not_empty;
  std::filesystem::remove(steps_path(folder), not_empty);
}

void remove_unfinished(const std::filesystem::path& folder) {
  for (const char* name : files) remove_file(next_of(folder / name));
  remove_file(next_of(particles_path(folder)));
}

}  // namespace vitrum::output
