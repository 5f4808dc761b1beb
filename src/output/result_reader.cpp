#include "output/result_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

OutputReader::OutputReader(const std::filesystem::path& path, const StoredStep& step, std::size_t particles)
    : file_(File::open_to_read(path)) {
  const Group& root = file_.root();
  if (const double time = root.number_attribute(".", "time"); time != step.time)
    throw FileError(fmt::format("{}: is of another run: its time is {} s, that of output {} is {} s",
                                path.string(), time, step.name, step.time));
  if (const std::int64_t index = root.integer_attribute(".", "step_index"); index != step.step_index)
    throw FileError(fmt::format("{}: is of another run: it is that of step {}, output {} of step {}",
                                path.string(), index, step.name, step.step_index));
  if (!root.has("particles")) return;
  const Group group = root.open_group("particles");
  for (const std::string& field : group.names()) {
    const Extent extent = group.extent(field);
    if (extent.rows != particles)
      throw FileError(fmt::format("{}: '{}' has {} rows, expected one for each of {} particles",
                                  group.label(), field, extent.rows, particles));
    fields_.push_back({field, extent.columns});
  }
}

bool OutputReader::has(const StoredField& field) const {
  return std::any_of(fields_.begin(), fields_.end(), [&](const StoredField& own) {
    return own.name == field.name && own.components == field.components;
  });
}

Field OutputReader::describe_field(const std::string& name) const {
  const Group group = file_.root().open_group("particles");
  return {name,
          group.text_attribute(name, "unit"),
          group.text_attribute(name, "description"),
          group.extent(name).columns,
          {}};
}

Field OutputReader::field(const std::string& name) const {
  Field field = describe_field(name);
  field.values = file_.root().open_group("particles").read_doubles(name);
  return field;
}

ResultReader::ResultReader(const std::filesystem::path& path)
    : path_(locate(path)), file_(File::open_to_read(path_)) {
  require_result(file_.root());
  if (const std::size_t count = count_steps(file_.root()); count > 0) {
    const std::vector<double> times = series_values("time"), indices = series_values("step_index");
    if (times.size() != count || indices.size() != count)
      throw FileError(fmt::format("{}: tells of {} outputs, and of the times of {}", path_.string(), count,
                                  times.size()));
    constexpr double whole = 9007199254740992.0;  // doubles count to 2^53
    for (std::size_t index = 0; index < count; ++index) {
      if (!(std::abs(indices[index]) <= whole))
        throw FileError(fmt::format("{}: output {} claims {} steps", path_.string(), index, indices[index]));
      steps_.push_back({step_name(index), times[index], static_cast<std::int64_t>(indices[index])});
    }
  }
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

ParticleConstants ResultReader::constants() const {
  const File file = File::open_to_read(particles_path(path_.parent_path()));
  const Group root = file.root().open_group("particles");
  ParticleConstants constants{bodies(), root.read_indices("body"), root.read_doubles("mass"),
                              root.read_doubles("size"), root.text_attribute("mass", "unit")};
  const std::size_t count = constants.bodies.size();
  if (std::any_of(constants.body.begin(), constants.body.end(),
                  [count](std::uint32_t index) { return index >= count; }))
    throw FileError(
        fmt::format("{}: names a body that /bodies of {} does not list", root.label(), path_.string()));
  if (constants.mass.size() != constants.body.size() || constants.size.size() != constants.body.size())
    throw FileError(fmt::format("{}: its arrays have different lengths", root.label()));
  return constants;
}

OutputReader ResultReader::output(std::size_t step) const {
  const std::filesystem::path folder = path_.parent_path();
  const std::size_t particles =
      File::open_to_read(particles_path(folder)).root().extent("particles/mass").rows;
  return OutputReader(step_path(folder, step), steps_.at(step), particles);
}

std::vector<double> ResultReader::series_values(const std::string& name) const {
  return file_.root().open_group("series").read_doubles(name);
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
