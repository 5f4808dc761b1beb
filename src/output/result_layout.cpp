#include "output/result_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace vitrum::output {
namespace {

void describe(const Group& group, const std::string& name, const std::string& unit,
              const std::string& description) {
  group.set_attribute(name, "unit", unit);
  group.set_attribute(name, "description", description);
}

void write_series_value(const Group& series, std::size_t row, const SeriesValue& value) {
  if (!series.has(value.name)) {
    series.create_series(value.name);
    describe(series, value.name, value.unit, value.description);
  }
  series.write_row(value.name, row, value.value);
}

void write_particle_constants(const Group& root, const ParticleConstants& constants) {
  const Group particles = root.create_group("particles");
  std::vector<std::uint32_t> index(constants.body.size());
  std::iota(index.begin(), index.end(), 0U);
  particles.write("body", constants.body);
  describe(particles, "body", "1", "index of the particle's body in /bodies");
  particles.write("mass", constants.mass);
  describe(particles, "mass", constants.mass_unit, "mass of the particle");
  particles.write("index", index);
  describe(particles, "index", "1",
           "number of the particle; visualisation uses it as the list of points to draw");
  root.write_texts("bodies", constants.bodies);
}

}  // namespace

void require_result(const Group& root) {
  if (!root.has_attribute(".", "format"))
    throw FileError(fmt::format("{} is not a vitrum result", root.label()));
  const std::string format = root.text_attribute(".", "format");
  if (format != result_format)
    throw FileError(fmt::format("{}: format '{}' is not '{}', the one this version reads", root.label(),
                                format, result_format));
}

void write_header(const Group& root, const RunHeader& header) {
  root.set_attribute(".", "format", std::string(result_format));
  root.set_attribute(".", "title", header.title);
  const Group scene = root.create_group("scene");
  scene.write_text("verbatim", header.scene_verbatim);
  scene.write_text("resolved", header.scene_resolved);
  const Group provenance = root.create_group("provenance");
  for (const ProvenanceEntry& entry : provenance_entries)
    provenance.set_attribute(".", std::string(entry.name), header.provenance.*entry.member);
  write_particle_constants(root, header.particles);
  root.create_group("steps");
  root.create_group("series");
}

void write_step(const Group& root, std::size_t index, const OutputFrame& frame) {
  const Group step = root.open_group("steps").create_group(step_name(index));
  step.set_attribute(".", "time", frame.time);
  step.set_attribute(".", "step_index", frame.step_index);
  if (frame.fields.empty()) return;
  const Group particles = step.create_group("particles");
  for (const Field& field : frame.fields) {
    particles.write(field.name, field.values, field.components);
    describe(particles, field.name, field.unit, field.description);
  }
}

void write_series(const Group& root, std::size_t row, const OutputFrame& frame) {
  const Group series = root.open_group("series");
  write_series_value(series, row, {"time", "s", "simulated time", frame.time});
  write_series_value(series, row,
                     {"step_index", "1", "time steps taken so far", static_cast<double>(frame.step_index)});
  for (const SeriesValue& value : frame.series) write_series_value(series, row, value);
}

std::size_t count_steps(const Group& root) {
  return root.open_group("steps").names().size();
}

std::size_t count_particles(const Group& root) {
  return root.extent("particles/mass").rows;
}

std::vector<StoredStep> read_steps(const Group& root) {
  const std::size_t particle_count = count_particles(root);
  const Group group = root.open_group("steps");
  std::vector<StoredStep> steps;
  const std::size_t count = count_steps(root);
  for (std::size_t index = 0; index < count; ++index) {
    const std::string name = step_name(index);
    if (!group.has(name))
      throw FileError(fmt::format("{}: {} outputs, but '{}' is missing", group.label(), count, name));
    const Group step = group.open_group(name);
    StoredStep entry{name, step.number_attribute(".", "time"), {}};
    if (step.has("particles")) {
      const Group particles = step.open_group("particles");
      for (const std::string& field : particles.names()) {
        const Extent extent = particles.extent(field);
        if (extent.rows != particle_count)
          throw FileError(fmt::format("{}: '{}' has {} rows, expected one for each of {} particles",
                                      particles.label(), field, extent.rows, particle_count));
        entry.fields.push_back({field, extent.columns});
      }
    }
    steps.push_back(std::move(entry));
  }
  return steps;
}

void copy_constants(const Group& from, const Group& to) {
  for (const char* name : {"format", "title"}) to.set_attribute(".", name, from.text_attribute(".", name));
  for (const char* name : {"scene", "provenance", "particles", "bodies"}) from.copy(name, to);
  to.create_group("steps");
  to.create_group("series");
}

void copy_steps(const Group& from, const Group& to, std::size_t first, std::size_t last) {
  const Group steps_from = from.open_group("steps"), steps_to = to.open_group("steps");
  for (std::size_t index = first; index < last; ++index) steps_from.copy(step_name(index), steps_to);

  const Group series_from = from.open_group("series"), series_to = to.open_group("series");
  for (const std::string& name : series_from.names()) {
    const std::vector<double> rows = series_from.read_doubles(name);
    for (std::size_t row = first; row < std::min(last, rows.size()); ++row)
      write_series_value(series_to, row,
                         {name, series_from.text_attribute(name, "unit"),
                          series_from.text_attribute(name, "description"), rows[row]});
  }
}

}  // namespace vitrum::output
