#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "output/hdf5.hpp"
#include "output/output_frame.hpp"

namespace vitrum::output {

/// A series with its attributes.
struct StoredSeries {
  std::string name, unit, description;
  std::vector<double> values;  ///< one per output; NaN where the run did not give one
};

/// A field as stored at one output.
struct StoredField {
  std::string name;
  std::size_t components;
};

/// One output, as the door tells of it.
struct StoredStep {
  std::string name;             ///< of the group below /steps: "00000", "00001", ...
  double time = 0.0;            ///< s
  std::int64_t step_index = 0;  ///< time steps taken so far
};

/// Reads the file of one output. Everything throws FileError.
class OutputReader {
 public:
  /// Throws also when the file tells another time than `step`, or has fields that are not of so many
  /// particles.
  OutputReader(const std::filesystem::path& path, const StoredStep& step, std::size_t particles);

  /// By name.
  const std::vector<StoredField>& fields() const { return fields_; }
  bool has(const StoredField& field) const;
  /// A field's unit, description and components, without its values.
  Field describe_field(const std::string& name) const;
  /// Values too: particles x components, row-major.
  Field field(const std::string& name) const;

 private:
  File file_;
  std::vector<StoredField> fields_;
};

/// Reads a result. Everything throws FileError: for a file that is no result, is damaged, or lacks what
/// is asked for.
class ResultReader {
 public:
  /// `path`: a result file, or a directory that holds a result.h5.
  explicit ResultReader(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  const std::vector<StoredStep>& steps() const { return steps_; }
  std::string title() const;
  std::string scene_verbatim() const;
  std::string scene_resolved() const;
  Provenance provenance() const;
  std::vector<std::string> bodies() const;
  /// What is constant of particles.
  ParticleConstants constants() const;
  /// Index into bodies() of every particle.
  std::vector<std::uint32_t> body_of_particle() const { return constants().body; }
  /// Output `step` < steps().size().
  OutputReader output(std::size_t step) const;
  std::vector<StoredSeries> series() const;

 private:
  std::vector<double> series_values(const std::string& name) const;

  std::filesystem::path path_;
  File file_;
  std::vector<StoredStep> steps_;
};

}  // namespace vitrum::output
