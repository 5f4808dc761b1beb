#include "app/run_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/messages.hpp"
#include "output/earlier_run.hpp"
#include "scene/input_error.hpp"

namespace vitrum::app {
namespace {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw FileError(fmt::format("{}: cannot be made: {}; --out names the folder for what a run leaves",
                                folder.string(), error.message()));
}

void require_checkpoint(const std::filesystem::path& folder) {
  const std::filesystem::path checkpoint = folder / "checkpoint.h5";
  std::error_code error;
  if (std::filesystem::exists(checkpoint, error)) return;
  throw FileError(fmt::format(
      "{}: cannot read: {}; --resume goes on from a checkpoint, which a run leaves when it is interrupted "
      "and "
      "as output.checkpoint_every asks; {}",
      checkpoint.string(), error ? error.message() : "No such file or directory",
      output::traces_of_run(folder).empty() ? "start without --resume"
                                            : "--force instead starts anew and replaces what is there"));
}

void require_free(const std::filesystem::path& folder) {
  const std::vector<std::string> traces = output::traces_of_run(folder);
  if (traces.empty()) return;
  const bool resumable = std::ranges::find(traces, "checkpoint.h5") != traces.end();
  throw InputError(
      fmt::format("{}: found an earlier run ({}), expected a folder without one: {}replace it by --force, or "
                  "choose another --out{}",
                  folder.string(), fmt::join(traces, ", "), resumable ? "continue it by --resume, " : "",
                  resumable ? "" : " (it left no checkpoint for --resume)"));
}

}  // namespace

std::filesystem::path folder_of(const RunOptions& options) {
  if (!options.directory.empty()) return options.directory;
  return std::filesystem::path("out") / std::filesystem::path(options.scene).stem();
}

output::FolderLock claim_folder(const RunOptions& options) {
  const std::filesystem::path folder = folder_of(options);
  std::error_code error;
  if (!options.resume)
    make_folder(folder);
  else if (!std::filesystem::is_directory(folder, error))
    require_checkpoint(folder);
  output::FolderLock lock(folder);
  if (!lock.locked())
    warn(fmt::format("{}: this file system has no locks; nothing keeps a second run out", folder.string()));
  if (options.resume) {
    require_checkpoint(folder);
    output::remove_unfinished(folder);
  } else {
    if (!options.force) require_free(folder);
    output::remove_run(folder);
  }
  return lock;
}

}  // namespace vitrum::app
