#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "output/hdf5.hpp"
#include "output/result_file.hpp"

namespace vitrum::output {

/// A series with its attributes.
struct StoredSeries {
  std::string name, unit, description;
  std::vector<double> values;  ///< one per output; NaN where the run did not give one
};

/// Reads a result file. Everything throws FileError: for a file that is no result, is damaged, or lacks what
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
  /// Index into bodies() of every particle.
  std::vector<std::uint32_t> body_of_particle() const;
  std::vector<double> mass() const;
  std::int64_t step_index(std::size_t step) const;
  /// A field's unit, description and components, without its values.
  Field describe_field(std::size_t step, const std::string& name) const;
  /// Values of a field at output `step` < steps().size(): particles x components, row-major.
  Field field(std::size_t step, const std::string& name) const;
  std::vector<StoredSeries> series() const;

 private:
  std::filesystem::path path_;
  File file_;
  std::vector<StoredStep> steps_;
};

}  // namespace vitrum::output
