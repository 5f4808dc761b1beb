#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "output/drawing.hpp"
#include "output/hdf5.hpp"
#include "output/output_frame.hpp"

// Where things stand in the files of a result: result.h5, steps/particles.h5 and steps/NNNNN.h5.

namespace vitrum::output {

/// Value of the root attribute `format` of every result file.
inline constexpr const char* result_format = "vitrum result 3";

/// Name of output `index`: at least five digits.
std::string step_name(std::size_t index);

/// Paths below a run's directory: the door, the tables, what is constant of particles, one output, and its
/// XDMF.
std::filesystem::path result_path(const std::filesystem::path& directory);
std::filesystem::path tables_path(const std::filesystem::path& directory);
std::filesystem::path steps_path(const std::filesystem::path& directory);
std::filesystem::path particles_path(const std::filesystem::path& directory);
std::filesystem::path step_path(const std::filesystem::path& directory, std::size_t index);
std::filesystem::path step_xdmf_path(const std::filesystem::path& directory, std::size_t index);

/// Throws FileError unless the file says that it is a result of a format that is known.
void require_result(const Group& root);

/// Into the door: everything that is written once, and /steps and /series without an output.
void write_header(const Group& root, const RunHeader& header);

/// Into steps/particles.h5: what is constant of particles.
void write_particles(const Group& root, const ParticleConstants& constants);

/// Into steps/NNNNN.h5: an output, and what is drawn of it.
void write_step(const Group& root, const OutputFrame& frame, const std::vector<DrawnBody>& drawn);

/// Into the door: links to the outputs from number `first` on, and their rows of every series, making series
/// that do not exist yet. Of the frames only time, step_index and series are looked at.
void enter_steps(const Group& root, std::size_t first, std::span<const OutputFrame> frames);

/// Takes all outputs but the first `outputs` out of the door.
void keep_steps(const Group& root, std::size_t outputs);

/// Number of outputs of a door. Throws FileError unless they are numbered without gaps.
std::size_t count_steps(const Group& root);

}  // namespace vitrum::output
