#include "output/result_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "output/result_layout.hpp"

namespace vitrum::output {
namespace {

std::filesystem::path locate(const std::filesystem::path& path) {
  std::error_code failure;
  std::filesystem::path file = std::filesystem::is_directory(path, failure) ? result_path(path) : path;
  const bool readable = std::filesystem::is_regular_file(file, failure);
  if (failure) throw FileError(fmt::format("{}: cannot read: {}", file.string(), failure.message()));
  if (!readable) throw FileError(fmt::format("{}: is not a file", file.string()));
  return file;
}

}  // namespace

ResultReader::ResultReader(const std::filesystem::path& path)
    : path_(locate(path)), file_(File::open_to_read(path_)) {
  require_result(file_.root());
  steps_ = read_steps(file_.root());
}

std::string ResultReader::title() const {
  return file_.root().text_attribute(".", "title");
}
std::string ResultReader::scene_verbatim() const {
  return file_.root().read_text("scene/verbatim");
}
std::string ResultReader::scene_resolved() const {
  return file_.root().read_text("scene/resolved");
}

Provenance ResultReader::provenance() const {
  Provenance provenance;
  for (const ProvenanceEntry& entry : provenance_entries)
    provenance.*entry.member = file_.root().text_attribute("provenance", std::string(entry.name));
  return provenance;
}

std::vector<std::string> ResultReader::bodies() const {
  return file_.root().read_texts("bodies");
}

std::vector<std::uint32_t> ResultReader::body_of_particle() const {
  std::vector<std::uint32_t> body = file_.root().read_indices("particles/body");
  const std::size_t count = bodies().size();
  if (std::any_of(body.begin(), body.end(), [count](std::uint32_t index) { return index >= count; }))
    throw FileError(
        fmt::format("{}: /particles/body names a body that /bodies does not list", path_.string()));
  return body;
}

std::vector<double> ResultReader::mass() const {
  return file_.root().read_doubles("particles/mass");
}

std::int64_t ResultReader::step_index(std::size_t step) const {
  return file_.root().integer_attribute("steps/" + steps_.at(step).name, "step_index");
}

Field ResultReader::describe_field(std::size_t step, const std::string& name) const {
  const Group group = file_.root().open_group("steps/" + steps_.at(step).name + "/particles");
  return {name,
          group.text_attribute(name, "unit"),
          group.text_attribute(name, "description"),
          group.extent(name).columns,
          {}};
}

Field ResultReader::field(std::size_t step, const std::string& name) const {
  Field field = describe_field(step, name);
  field.values = file_.root().open_group("steps/" + steps_.at(step).name + "/particles").read_doubles(name);
  return field;
}

std::vector<StoredSeries> ResultReader::series() const {
  const Group group = file_.root().open_group("series");
  std::vector<StoredSeries> series;
  for (const std::string& name : group.names())
    series.push_back({name, group.text_attribute(name, "unit"), group.text_attribute(name, "description"),
                      group.read_doubles(name)});
  return series;
}

}  // namespace vitrum::output
