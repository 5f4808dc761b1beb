#include "output/result_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "output/atomic_file.hpp"
#include "output/descriptor.hpp"
#include "output/result_reader.hpp"
#include "output/xdmf.hpp"

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

std::filesystem::path xdmf_path(const std::filesystem::path& directory) {
  return directory / "result.xdmf";
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw_file_error(path, "read", errno);
  return content;
}

std::string_view text_of(std::span<const char> bytes) {
  return {bytes.data(), bytes.size()};
}

void make_steps_folder(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directory(steps_path(directory), error);
  if (error) throw_file_error(steps_path(directory), "make the folder", error.value());
}

}  // namespace

ResultFile::ResultFile(std::filesystem::path directory, std::string door, ParticleConstants constants)
    : directory_(std::move(directory)), door_(std::move(door)), constants_(std::move(constants)) {}

ResultFile ResultFile::create(const std::filesystem::path& directory, const RunHeader& header) {
  make_steps_folder(directory);
  File particles = File::create(particles_path(directory)), door = File::create(result_path(directory));
  write_particles(particles.root(), header.particles);
  put_in_place(particles_path(directory), text_of(particles.close()));
  write_header(door.root(), header);
  ResultFile result(directory, std::string(text_of(door.close())), header.particles);
  put_in_place(result_path(directory), result.door_);
  return result;
}

ResultFile ResultFile::reopen(const std::filesystem::path& directory, std::size_t outputs) {
  const ResultReader earlier(directory);
  if (earlier.steps().size() < outputs)
    throw FileError(
        fmt::format("{}: holds {} outputs, fewer than the {} that were written before the checkpoint",
                    earlier.path().string(), earlier.steps().size(), outputs));
  std::string bytes = content_of(earlier.path());
  File door = File::open_image(earlier.path(), bytes);
  keep_steps(door.root(), outputs);
  ResultFile result(directory, std::string(text_of(door.close())), earlier.constants());
  for (std::size_t index = 0; index < outputs; ++index) {
    earlier.output(index);  // throws where it is missing
    result.times_.push_back(earlier.steps()[index].time);
    if (std::filesystem::exists(step_xdmf_path(directory, index))) result.drawn_.push_back(index);
  }
  put_in_place(result_path(directory), result.door_);
  result.show_drawn();
  remove_outputs(directory, outputs);
  return result;
}

void ResultFile::append(const OutputFrame& frame) {
  require_consistent(frame, particles());
  const std::size_t index = outputs();
  const std::vector<DrawnBody> drawn = drawing(frame, constants_);
  File step = File::create(step_path(directory_, index));
  write_step(step.root(), frame, drawn);
  behind_.push_back({frame.time, frame.step_index, {}, frame.series, {}});
  times_.push_back(frame.time);
  if (!drawn.empty()) drawn_.push_back(index);
  try {
    put_in_place(step_path(directory_, index), text_of(step.close()));
    if (!drawn.empty()) put_in_place(step_xdmf_path(directory_, index), step_xdmf(index, frame.time, drawn));
    if (door_is_due()) show();
  } catch (...) {
    if (!behind_.empty()) forget(index);
    throw;
  }
}

/// Undoes an output that result.h5 does not lead to yet.
void ResultFile::forget(std::size_t index) {
  behind_.pop_back(), times_.pop_back();
  std::erase(drawn_, index);
  std::error_code missing;
  std::filesystem::remove(step_path(directory_, index), missing);
  std::filesystem::remove(step_xdmf_path(directory_, index), missing);
}

bool ResultFile::door_is_due() const {
  constexpr std::size_t always = 64;
  constexpr std::chrono::milliseconds longest(50);
  return behind_.size() * always >= outputs() || std::chrono::steady_clock::now() - shown_at_ > longest;
}

void ResultFile::show() {
  File door = File::open_image(result_path(directory_), door_);
  enter_steps(door.root(), outputs() - behind_.size(), behind_);
  std::string bytes(text_of(door.close()));
  put_in_place(result_path(directory_), bytes);
  door_ = std::move(bytes);
  behind_.clear();
  shown_at_ = std::chrono::steady_clock::now();
  show_drawn();
}

void ResultFile::show_drawn() const {
  if (drawn_.empty())
    remove_file(xdmf_path(directory_));  // of outputs that are no more
  else
    put_in_place(xdmf_path(directory_), xdmf_text(drawn_));
}

void ResultFile::settle() {
  if (!behind_.empty()) show();
  force_to_disk(directory_);
}

namespace {

/// Number of the output that a file below steps/ belongs to: "00012.h5", "00012.xmf", ".00012.h5.next".
std::optional<std::size_t> output_of(std::string name) {
  if (name.starts_with('.') && name.ends_with(".next")) name = name.substr(1, name.size() - 6);
  const std::size_t dot = name.find('.');
  const std::string digits = name.substr(0, dot);
  if (dot == std::string::npos || (name.substr(dot) != ".h5" && name.substr(dot) != ".xmf"))
    return std::nullopt;
  if (digits.size() < 5 || digits.size() > 18 || digits.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return std::stoull(digits);
}

std::vector<std::pair<std::size_t, std::filesystem::path>> files_of_outputs(
    const std::filesystem::path& directory) {
  std::vector<std::pair<std::size_t, std::filesystem::path>> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(steps_path(directory), none))
    if (const auto index = output_of(entry.path().filename().string()))
      files.emplace_back(*index, entry.path());
  return files;
}

}  // namespace

void remove_outputs(const std::filesystem::path& directory, std::size_t first) {
  for (const auto& [index, path] : files_of_outputs(directory))
    if (index >= first) remove_file(path);
}

bool has_outputs(const std::filesystem::path& directory) {
  return !files_of_outputs(directory).empty();
}

}  // namespace vitrum::output
