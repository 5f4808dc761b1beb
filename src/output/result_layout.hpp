#pragma once
#include <cstddef>
#include <vector>

#include "output/hdf5.hpp"
#include "output/output_frame.hpp"
#include "output/result_file.hpp"

namespace vitrum::output {

/// Value of the root attribute `format` of every result file.
inline constexpr const char* result_format = "vitrum result 2";

/// Throws FileError unless the file says that it is a result of a format that is known.
void require_result(const Group& root);

/// Everything that is written once, and the empty groups /steps and /series.
void write_header(const Group& root, const RunHeader& header);

/// Group /steps/NNNNN with its attributes and fields.
void write_step(const Group& root, std::size_t index, const OutputFrame& frame);

/// Row `row` of every series of the frame, making series that do not exist yet.
void write_series(const Group& root, std::size_t row, const OutputFrame& frame);

/// Number of outputs of a file.
std::size_t count_steps(const Group& root);

/// Number of particles of a file; 0: it stores no particle data.
std::size_t count_particles(const Group& root);

/// The outputs of a file, in order. Throws FileError when they are not numbered without gaps, or a field does
/// not belong to the file's particles.
std::vector<StoredStep> read_steps(const Group& root);

/// Copies what write_header wrote.
void copy_constants(const Group& from, const Group& to);

/// Copies outputs [first, last) with their series rows; `to` holds the outputs before `first`.
void copy_steps(const Group& from, const Group& to, std::size_t first, std::size_t last);

}  // namespace vitrum::output
