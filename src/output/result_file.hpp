#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "output/output_frame.hpp"
#include "output/result_layout.hpp"

namespace vitrum::output {

/// Writes the outputs of a run: a file each, DIR/steps/NNNNN.h5, and the door to them, DIR/result.h5, with
/// links to the outputs and their series; DIR/result.xdmf in the same way, over steps/NNNNN.xmf.
///
/// Every file is written under a hidden name, closed and renamed: a process that is killed at any instruction
/// leaves complete outputs, and a door that leads to complete outputs only. Nothing is forced to disk but by
/// settle().
///
/// The door is kept in memory and written as a whole. It is small, but grows with the number n of outputs: so
/// where they follow each other within 50 ms, it follows in groups of n/64, and a run's time is linear in its
/// outputs.
class ResultFile {
 public:
  /// Starts an empty result in the existing directory `directory`, replacing an earlier one. Throws
  /// FileError.
  static ResultFile create(const std::filesystem::path& directory, const RunHeader& header);
  /// Continues a result, keeping its first `outputs` outputs and removing the others. Throws FileError when
  /// it holds fewer.
  static ResultFile reopen(const std::filesystem::path& directory, std::size_t outputs);

  /// Adds one output. On FileError (disk full, ...) the result is as it was before.
  void append(const OutputFrame& frame);
  /// Lets the door show all outputs, and forces everything to disk.
  void settle();

  std::size_t outputs() const { return times_.size(); }
  /// Time of the last output, s.
  double last_time() const { return times_.back(); }
  /// Particles per field (0: the run stores no particle data).
  std::size_t particles() const { return constants_.body.size(); }

 private:
  ResultFile(std::filesystem::path directory, std::string door, ParticleConstants constants);
  bool door_is_due() const;
  void forget(std::size_t index);
  void show();
  void show_drawn() const;

  std::filesystem::path directory_;
  std::string door_;  ///< bytes of result.h5
  ParticleConstants constants_;
  std::vector<double> times_;
  std::vector<std::size_t> drawn_;   ///< outputs with an XDMF file
  std::vector<OutputFrame> behind_;  ///< outputs that result.h5 does not lead to yet, without their fields
  std::chrono::steady_clock::time_point shown_at_;
};

/// Removes the files of all outputs from number `first` on, whole ones and those in the making. Throws
/// FileError.
void remove_outputs(const std::filesystem::path& directory, std::size_t first);

/// Whether there is a file of an output.
bool has_outputs(const std::filesystem::path& directory);

}  // namespace vitrum::output
