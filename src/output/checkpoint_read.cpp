#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "output/checkpoint.hpp"
#include "output/checkpoint_columns.hpp"
#include "output/checkpoint_header.hpp"
#include "output/hdf5.hpp"
#include "output/regular_file.hpp"
#include "output/result_layout.hpp"
#include "scene/sha256.hpp"

namespace vitrum::output {
namespace {

/// HDF5 1.10 can crash on a damaged file; so the bytes are compared with their digest before HDF5 sees them.
void require_intact(const std::filesystem::path& path) {
  require_regular_file(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(fmt::format("{}: cannot read: {}", path.string(), std::strerror(errno)));
  std::string line(checkpoint_header(sha256("")).size(), '\0');
  file.read(line.data(), static_cast<std::streamsize>(line.size()));
  if (!line.starts_with(checkpoint_magic))
    throw FileError(
        fmt::format("{}: is not a checkpoint of this version: it does not begin with '{}'; --force instead "
                    "of --resume starts anew",
                    path.string(), checkpoint_magic));
  std::error_code failure;
  if (std::filesystem::file_size(path, failure) < checkpoint_header_size || failure ||
      line != checkpoint_header(sha256_of_file(path, checkpoint_header_size)))
    throw FileError(
        fmt::format("{}: is truncated or damaged: its content does not match its SHA-256; --force instead of "
                    "--resume starts anew",
                    path.string()));
}

void require_size(const Group& group, const std::string& name, std::size_t found, std::size_t expected) {
  if (found != expected)
    throw FileError(
        fmt::format("{}: '{}' has {} entries, expected {}", group.label(), name, found, expected));
}

BodyCheckpoint read_body(const Group& group) {
  BodyCheckpoint body{group.text_attribute(".", "name"), {}, {}};
  Particles& particles = body.particles;
  particles.identity = group.read_indices("identity");
  particles.size = particles.identity.size();
  for (const auto& [name, column] : stored_columns(particles)) {
    if (may_be_absent(particles, *column) && !group.has(name)) continue;
    *column = group.read_doubles(name);
    require_size(group, name, column->size(), particles.size);
  }
  const Group variables = group.open_group("variables");
  for (const std::string& name : variables.names()) {
    std::vector<double>& column = body.variables[name];
    column = variables.read_doubles(name);
    require_size(variables, name, column.size(), particles.size);
  }
  return body;
}

[[noreturn]] void differ(std::string_view what, std::string_view found, std::string_view expected) {
  throw FileError(fmt::format("the checkpoint does not belong to this scene: {}: found {}, expected {}", what,
                              found, expected));
}

/// Rows of outputs are found by identity.
void require_permutation(const BodyCheckpoint& body) {
  std::vector<bool> seen(body.particles.size, false);
  for (const std::uint32_t identity : body.particles.identity) {
    if (identity >= seen.size() || seen[identity])
      differ(fmt::format("identities of body '{}'", body.name), std::to_string(identity),
             fmt::format("each from 0 to {} once", seen.size() - 1));
    seen[identity] = true;
  }
}

std::string list_of(std::set<std::string> names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

/// Takes the columns of a body by their names.
void restore_variables(const BodyCheckpoint& stored, Body& body) {
  std::set<std::string> found, expected;
  for (const auto& [name, column] : stored.variables) found.insert(name);
  for (const Component& column : body.material->columns()) expected.insert(column.name);
  if (found != expected)
    differ(fmt::format("variables of body '{}'", body.name), list_of(found), list_of(expected));
  for (std::size_t k = 0; k < body.particles.variables.size(); ++k)
    body.particles.variables[k] = stored.variables.at(body.material->columns()[k].name);
}

/// One array holds all numbers, one text their names: a data set for each would cost 300 bytes a number.
Archive read_state(const Group& group) {
  Archive state;
  const std::vector<double> values = group.read_doubles("values");
  std::istringstream names(group.read_text("names"));
  std::string name;
  for (std::size_t size = 0, at = 0; names >> name >> size; at += size) {
    if (size > values.size() - at)
      throw FileError(fmt::format("{}: '{}' has {} numbers, of which {} are there", group.label(), name, size,
                                  values.size() - at));
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(at);
    state.put(name, std::vector<double>(first, first + static_cast<std::ptrdiff_t>(size)));
  }
  const Group texts = group.open_group("texts");
  for (const std::string& text : texts.names()) state.put_text(text, texts.read_text(text));
  return state;
}

}  // namespace

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  require_intact(path);
  const File file = File::open_to_read(path);
  const Group& root = file.root();
  Checkpoint checkpoint;
  checkpoint.time = root.number_attribute(".", "time");
  if (!std::isfinite(checkpoint.time))
    throw FileError(fmt::format("{}: its time is {}", path.string(), checkpoint.time));
  checkpoint.step_index = root.integer_attribute(".", "step_index");
  checkpoint.scene_sha256 = root.text_attribute(".", "scene_sha256");
  const Group bodies = root.open_group("bodies");
  const std::size_t count = bodies.names().size();
  for (std::size_t index = 0; index < count; ++index)
    checkpoint.bodies.push_back(read_body(bodies.open_group(step_name(index))));
  checkpoint.state = read_state(root.open_group("state"));
  return checkpoint;
}

void restore_bodies(const Checkpoint& checkpoint, std::span<Body> bodies) {
  if (checkpoint.bodies.size() != bodies.size())
    differ("bodies", std::to_string(checkpoint.bodies.size()), std::to_string(bodies.size()));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyCheckpoint& stored = checkpoint.bodies[b];
    Body& body = bodies[b];
    if (stored.name != body.name) differ(fmt::format("body {}", b), stored.name, body.name);
    if (stored.particles.size != body.particles.size)
      differ(fmt::format("particles of body '{}'", body.name), std::to_string(stored.particles.size),
             std::to_string(body.particles.size));
    require_permutation(stored);
    restore_variables(stored, body);
    body.particles.identity = stored.particles.identity;
    const auto copy = [](const auto& from, const auto& to) {
      for (std::size_t c = 0; c < from.size(); ++c) *to[c].second = *from[c].second;
    };
    copy(stored_columns(stored.particles), stored_columns(body.particles));
  }
}

}  // namespace vitrum::output
