#include "output/result_layout.hpp"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <numeric>

namespace vitrum::output {
namespace {

void describe(const Group& group, const std::string& name, const std::string& unit,
              const std::string& description) {
  group.set_attribute(name, "unit", unit);
  group.set_attribute(name, "description", description);
}

/// What an output adds to the series.
std::vector<Quantity> series_of(const OutputFrame& frame) {
  std::vector<Quantity> values = {
      {"time", "s", "simulated time", frame.time},
      {"step_index", "1", "time steps taken so far", static_cast<double>(frame.step_index)}};
  values.insert(values.end(), frame.series.begin(), frame.series.end());
  return values;
}

std::vector<std::uint32_t> counted(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

/// The arrays of every body that are constant, with the list of points to draw; or those that are not.
void write_drawn(const Group& root, const std::vector<DrawnBody>& drawn, bool constant) {
  if (drawn.empty()) return;
  const Group bodies = root.create_group("drawn");
  for (std::size_t number = 0; number < drawn.size(); ++number) {
    const Group body = bodies.create_group(std::to_string(number));
    if (constant) body.write("index", counted(drawn[number].particles));
    for (const DrawnArray& array : drawn[number].arrays)
      if (array.constant == constant) body.write(array.name, array.values, array.components);
  }
}

std::string file_of_step(std::size_t index) {
  return step_name(index) + ".h5";
}

}  // namespace

std::string step_name(std::size_t index) {
  return fmt::format("{:05d}", index);
}

std::filesystem::path result_path(const std::filesystem::path& directory) {
  return directory / "result.h5";
}
std::filesystem::path tables_path(const std::filesystem::path& directory) {
  return directory / "tables.h5";
}
std::filesystem::path steps_path(const std::filesystem::path& directory) {
  return directory / "steps";
}
std::filesystem::path particles_path(const std::filesystem::path& directory) {
  return steps_path(directory) / "particles.h5";
}
std::filesystem::path step_path(const std::filesystem::path& directory, std::size_t index) {
  return steps_path(directory) / file_of_step(index);
}
std::filesystem::path step_xdmf_path(const std::filesystem::path& directory, std::size_t index) {
  return steps_path(directory) / (step_name(index) + ".xmf");
}

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
  root.write_texts("bodies", header.particles.bodies);
  root.link_to_file("particles", "steps/particles.h5", "/particles");
  root.link_to_file("tables", "tables.h5", "/");
  root.link_to_file("events", "tables.h5", "/events");
  root.create_group("steps");
  root.create_group("series");
}

void write_particles(const Group& root, const ParticleConstants& constants) {
  const Group particles = root.create_group("particles");
  particles.write("body", constants.body);
  describe(particles, "body", "1", "index of the particle's body in /bodies");
  particles.write("mass", constants.mass);
  describe(particles, "mass", constants.mass_unit, "mass of the particle");
  particles.write("size", constants.size);
  describe(particles, "size", "m", "side of the particle's square at the start");
  const std::vector<std::uint32_t> numbers = counted(constants.body.size());
  particles.write("index", numbers);
  describe(particles, "index", "1", "number of the particle");
  write_drawn(root, drawn_constants(constants), true);
}

void write_step(const Group& root, const OutputFrame& frame, const std::vector<DrawnBody>& drawn) {
  root.set_attribute(".", "time", frame.time);
  root.set_attribute(".", "step_index", frame.step_index);
  if (frame.fields.empty()) return;
  const Group particles = root.create_group("particles");
  for (const Field& field : frame.fields) {
    particles.write(field.name, field.values, field.components);
    describe(particles, field.name, field.unit, field.description);
  }
  write_drawn(root, drawn, false);
}

void enter_steps(const Group& root, std::size_t first, std::span<const OutputFrame> frames) {
  const Group steps = root.open_group("steps"), series = root.open_group("series");
  std::map<std::string, std::vector<double>> rows;
  for (std::size_t n = 0; n < frames.size(); ++n) {
    steps.link_to_file(step_name(first + n), "steps/" + file_of_step(first + n), "/");
    for (const Quantity& value : series_of(frames[n])) {
      if (!series.has(value.name)) {
        series.create_series(value.name);
        describe(series, value.name, value.unit, value.description);
      }
      rows.try_emplace(value.name, frames.size(), std::numeric_limits<double>::quiet_NaN()).first->second[n] =
          value.value;
    }
  }
  for (const auto& [name, values] : rows) series.write_rows(name, first, values);
}

void keep_steps(const Group& root, std::size_t outputs) {
  const Group steps = root.open_group("steps"), series = root.open_group("series");
  for (std::size_t index = outputs; steps.has(step_name(index)); ++index) steps.remove(step_name(index));
  for (const std::string& name : series.names()) series.keep_rows(name, outputs);
}

std::size_t count_steps(const Group& root) {
  const Group group = root.open_group("steps");
  const std::vector<std::string> names = group.names();
  for (std::size_t index = 0; index < names.size(); ++index)
    if (!group.has(step_name(index)))
      throw FileError(
          fmt::format("{}: {} outputs, but '{}' is missing", group.label(), names.size(), step_name(index)));
  return names.size();
}

}  // namespace vitrum::output
