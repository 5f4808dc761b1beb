#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "output/hdf5.hpp"
#include "output/output_frame.hpp"

namespace vitrum::output {

/// A field as stored at one output.
struct StoredField {
  std::string name;
  std::size_t components;
};

/// One output of a result file.
struct StoredStep {
  std::string name;   ///< of the group below /steps: "00000", "00001", ...
  double time = 0.0;  ///< s
  std::vector<StoredField> fields;
};

/// Writes DIR/result.h5, which can be read, complete up to the last output, at any moment: during the run,
/// and after the process has been killed at any instruction.
///
/// HDF5 promises nothing about a file whose writer is killed, so result.h5 is never open for writing. There
/// are two files, result.h5 and a hidden shadow one output behind it. An output brings the shadow up to date
/// by copying the bytes that the last output has written, adds the new step, closes it, forces it to disk,
/// and exchanges the names of the two files in one atomic step (renameat2 with RENAME_EXCHANGE). An output is
/// therefore written twice, but never more often, however many there are; a file that were copied as a whole
/// would cost ever more. The shadow begins as a copy of result.h5, and is made one again where that is
/// needed: when the file system cannot exchange names and it has been renamed over result.h5; when another
/// program still reads it, as a lock shows, as the result.h5 it once was; when another program has changed
/// either file. During an output, result.h5 is locked for reading, as HDF5 does: a program that honours locks
/// cannot open for writing what is about to be replaced.
class ResultFile {
 public:
  /// How the shadow becomes result.h5.
  enum class Publishing { exchange, replace };

  /// Starts an empty result in the existing directory `directory`, replacing an earlier one. Throws
  /// FileError.
  static ResultFile create(const std::filesystem::path& directory, const RunHeader& header,
                           Publishing publishing = Publishing::exchange);
  /// Continues a result, keeping its first `outputs` outputs. Throws FileError when it holds fewer.
  static ResultFile reopen(const std::filesystem::path& directory, std::size_t outputs,
                           Publishing publishing = Publishing::exchange);

  ResultFile(ResultFile&&) = default;
  ResultFile& operator=(ResultFile&&) = default;
  ~ResultFile();

  /// Adds one output. On FileError (disk full, result.h5 is open for writing elsewhere or holds other outputs
  /// than those that were written, ...) result.h5 is as it was before.
  void append(const OutputFrame& frame);
  /// Deletes the shadow. result.h5 needs no closing: also an object that is never closed leaves it complete.
  void close();
  /// Leaves the shadow alone from now on: its path leads into a folder that is no longer this run's.
  void abandon() { shadow_.clear(); }

  const std::vector<StoredStep>& steps() const { return steps_; }
  /// Particles per field (0: the run stores no constant particle data).
  std::size_t particles() const { return particles_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  ResultFile(const std::filesystem::path& directory, Publishing publishing);
  File open_shadow(const Descriptor& result) const;
  bool bring_shadow_level(const Descriptor& result) const;
  void publish();

  std::filesystem::path path_, shadow_;
  Publishing publishing_;
  std::size_t particles_ = 0;
  std::vector<StoredStep> steps_;
  std::vector<ByteRange> ahead_;  // what result.h5 has and the shadow, if there is one, has not
  FileVersion published_;         // result.h5 after the last output
  FileVersion replaced_;          // the file whose place it took, and which is the shadow now
};

/// Name of step group `index`: at least five digits.
std::string step_name(std::size_t index);

/// Path of the result file below a run's directory.
std::filesystem::path result_path(const std::filesystem::path& directory);

}  // namespace vitrum::output
