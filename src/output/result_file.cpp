#include "output/result_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "output/atomic_file.hpp"
#include "output/descriptor.hpp"
#include "output/result_layout.hpp"

namespace vitrum::output {
namespace {

void require_consistent(const OutputFrame& frame, std::size_t particles) {
  for (const Field& field : frame.fields) {
    if (field.components == 0 || field.values.size() != particles * field.components)
      throw std::invalid_argument(
          fmt::format("field '{}' has {} values, expected {} particles x {} components", field.name,
                      field.values.size(), particles, field.components));
  }
}

StoredStep stored(std::size_t index, const OutputFrame& frame) {
  StoredStep step{step_name(index), frame.time, {}};
  for (const Field& field : frame.fields) step.fields.push_back({field.name, field.components});
  std::sort(step.fields.begin(), step.fields.end(),
            [](const StoredField& a, const StoredField& b) { return a.name < b.name; });
  return step;
}

}  // namespace

ResultFile::ResultFile(const std::filesystem::path& directory, Publishing publishing)
    : path_(result_path(directory)), shadow_(next_of(path_)), publishing_(publishing) {
  std::error_code missing;
  std::filesystem::remove(shadow_, missing);  // an earlier run that was killed leaves one
}

ResultFile::~ResultFile() {
  if (shadow_.empty()) return;  // moved from, or abandoned
  std::error_code missing;
  std::filesystem::remove(shadow_, missing);
}

ResultFile ResultFile::create(const std::filesystem::path& directory, const RunHeader& header,
                              Publishing publishing) {
  ResultFile result(directory, publishing);
  File file = File::create(result.shadow_);
  write_header(file.root(), header);
  file.close();
  replace_with(result.shadow_, result.path_);
  result.particles_ = header.particles.body.size();
  return result;
}

ResultFile ResultFile::reopen(const std::filesystem::path& directory, std::size_t outputs,
                              Publishing publishing) {
  ResultFile result(directory, publishing);
  File old = File::open_to_read(result.path_);
  require_result(old.root());
  result.steps_ = read_steps(old.root());
  result.particles_ = count_particles(old.root());
  if (result.steps_.size() < outputs)
    throw FileError(
        fmt::format("{}: holds {} outputs, fewer than the {} that were written before the checkpoint",
                    result.path_.string(), result.steps_.size(), outputs));
  if (result.steps_.size() == outputs) return result;
  File shortened = File::create(result.shadow_);
  copy_constants(old.root(), shortened.root());
  copy_steps(old.root(), shortened.root(), 0, outputs);
  shortened.close();
  old.close();
  replace_with(result.shadow_, result.path_);
  result.steps_.resize(outputs);
  return result;
}

/// False where a copy must take the shadow's place: one of the two files is not what it was after the last
/// output, or another program still has the shadow open as the result.h5 that it once was.
bool ResultFile::bring_shadow_level(const Descriptor& result) const {
  const FileVersion version = result.version();
  Descriptor shadow(shadow_, O_WRONLY);
  if (!shadow.lock_for_writing() || version != published_ || shadow.version() != replaced_) return false;
  for (const ByteRange& part : ahead_) shadow.write_part_of(result, part);
  shadow.truncate(version.size);
  shadow.close();
  return true;
}

File ResultFile::open_shadow(const Descriptor& result) const {
  std::error_code failure;
  if (std::filesystem::exists(shadow_, failure)) {
    try {
      if (bring_shadow_level(result)) return File::open_to_write(shadow_);
    } catch (const FileError&) {
      // It is write-protected, or has been locked meanwhile; what a copy does not cure either, a copy tells.
    }
    remove_file(shadow_);  // (a program that reads it keeps it)
  }
  Descriptor copy(shadow_, O_WRONLY | O_CREAT | O_EXCL);
  copy.write_all_of(result);
  copy.close();
  File file = File::open_to_write(shadow_);
  if (const std::size_t present = count_steps(file.root()); present != steps_.size())
    throw FileError(fmt::format(
        "{}: holds {} outputs, but this run has written {}: another program has changed or replaced it",
        path_.string(), present, steps_.size()));
  return file;
}

void ResultFile::append(const OutputFrame& frame) {
  require_consistent(frame, particles_);
  // Until the new file has taken its place, so that nobody changes what is about to be replaced.
  Descriptor result(path_, O_RDONLY);
  if (!result.lock_for_reading())
    throw FileError(
        fmt::format("{}: another program has it open for writing; no output can be added", path_.string()));
  const FileVersion version = result.version();
  try {
    File shadow = open_shadow(result);
    write_step(shadow.root(), steps_.size(), frame);
    write_series(shadow.root(), steps_.size(), frame);
    ahead_ = shadow.close();
    published_ = Descriptor(shadow_, O_RDONLY).version();
    replaced_ = version;
    publish();
  } catch (...) {
    std::error_code missing;
    std::filesystem::remove(shadow_, missing);  // half written; the next attempt begins with a copy
    throw;
  }
  steps_.push_back(stored(steps_.size(), frame));
}

void ResultFile::publish() {
  if (publishing_ == Publishing::exchange && exchange_with(shadow_, path_)) return;
  publishing_ = Publishing::replace;
  replace_with(shadow_, path_);
}

void ResultFile::close() {
  std::error_code missing;
  std::filesystem::remove(shadow_, missing);
}

std::string step_name(std::size_t index) {
  return fmt::format("{:05d}", index);
}

std::filesystem::path result_path(const std::filesystem::path& directory) {
  return directory / "result.h5";
}

}  // namespace vitrum::output
