#include <fmt/format.h>

#include <algorithm>

#include "output/atomic_file.hpp"
#include "output/checkpoint.hpp"
#include "output/checkpoint_columns.hpp"
#include "output/checkpoint_header.hpp"
#include "output/hdf5.hpp"
#include "output/result_layout.hpp"
#include "scene/sha256.hpp"

namespace vitrum::output {
namespace {

void write_body(const Group& group, const BodyCheckpoint& body) {
  group.set_attribute(".", "name", body.name);
  group.write("identity", body.particles.identity);
  for (const auto& [name, column] : stored_columns(body.particles)) {
    if (!column->empty()) group.write(name, *column);
  }
  const Group variables = group.create_group("variables");
  for (const auto& [name, column] : body.variables) variables.write(name, column);
}

void write_state(const Group& group, const Archive& state) {
  std::string names;
  std::vector<double> all;
  for (const auto& [name, values] : state.all_numbers()) {
    names += fmt::format("{} {}\n", name, values.size());
    all.insert(all.end(), values.begin(), values.end());
  }
  group.write_text("names", names);
  group.write("values", all);
  const Group texts = group.create_group("texts");
  for (const auto& [name, text] : state.all_texts()) texts.write_text(name, text);
}

void write_content(const Group& root, const Checkpoint& checkpoint) {
  root.set_attribute(".", "time", checkpoint.time);
  root.set_attribute(".", "step_index", checkpoint.step_index);
  root.set_attribute(".", "scene_sha256", checkpoint.scene_sha256);
  const Group bodies = root.create_group("bodies");
  for (std::size_t index = 0; index < checkpoint.bodies.size(); ++index)
    write_body(bodies.create_group(step_name(index)), checkpoint.bodies[index]);
  write_state(root.create_group("state"), checkpoint.state);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  File file = File::create(path, checkpoint_header_size);
  write_content(file.root(), checkpoint);
  const std::span<char> bytes = file.close();
  // HDF5 leaves the first bytes of the file to its user: they take the header line.
  const std::string_view all(bytes.data(), bytes.size());
  const std::string line = checkpoint_header(sha256(all.substr(checkpoint_header_size)));
  std::copy(line.begin(), line.end(), bytes.begin());
  write_text_atomically(path, all);
}

std::vector<BodyCheckpoint> checkpoint_bodies(std::span<const Body> bodies) {
  std::vector<BodyCheckpoint> stored;
  for (const Body& body : bodies) {
    BodyCheckpoint entry{body.name, {}, {}};
    entry.particles.size = body.particles.size;
    entry.particles.identity = body.particles.identity;
    const auto copy = [](const auto& from, const auto& to) {
      for (std::size_t c = 0; c < from.size(); ++c) *to[c].second = *from[c].second;
    };
    copy(stored_columns(body.particles), stored_columns(entry.particles));
    for (std::size_t k = 0; k < body.particles.variables.size(); ++k)
      entry.variables[body.material->columns()[k].name] = body.particles.variables[k];
    stored.push_back(std::move(entry));
  }
  return stored;
}

}  // namespace vitrum::output
