#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mpm/particles.hpp"
#include "observe/archive.hpp"

namespace vitrum::output {

/// The stored columns of one body, in storage order (scratch columns are neither written nor read).
struct BodyCheckpoint {
  std::string name;
  Particles particles;                                   ///< without their variables
  std::map<std::string, std::vector<double>> variables;  ///< columns by name
};

/// Everything needed to go on as if nothing had happened; every number is restored bit for bit.
struct Checkpoint {
  double time = 0.0;  ///< s
  std::int64_t step_index = 0;
  std::string scene_sha256;  ///< of the resolved scene that was run
  std::vector<BodyCheckpoint> bodies;
  /// State of anything else, by name. Its texts: scene (resolved, as scene_sha256 tells), command (what
  /// continues the run), rows of tables that could not be written yet.
  Archive state;
};

/// Writes atomically: `path` holds either its former checkpoint or all of this one. An HDF5 file with a
/// header line that carries the SHA-256 of the rest. Throws FileError.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Reads and validates. A file that is no checkpoint, truncated or altered by a single bit is refused with
/// FileError before any of it is interpreted; so are columns of different lengths and unknown variables.
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// The checkpoint's view of bodies.
std::vector<BodyCheckpoint> checkpoint_bodies(std::span<const Body> bodies);

/// Puts the stored columns into bodies seeded from the same scene; scratch columns stay. Throws FileError
/// naming what differs when names, numbers of particles or stored variables are not those of `bodies`.
void restore_bodies(const Checkpoint& checkpoint, std::span<Body> bodies);

}  // namespace vitrum::output
