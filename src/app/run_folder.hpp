#pragma once
#include <filesystem>

#include "app/run_command.hpp"
#include "output/folder_lock.hpp"

namespace vitrum::app {

/// The folder that the options name: out/NAME-OF-SCENE when they name none.
std::filesystem::path folder_of(const RunOptions& options);

/// The folder that the options name, made if need be, held for this process, and ready to start or to resume
/// in. Throws InputError where another run is under way, or where an earlier one left results that the
/// options neither continue
/// (--resume) nor replace (--force); FileError where there is no checkpoint to resume from, or no access.
output::FolderLock claim_folder(const RunOptions& options);

}  // namespace vitrum::app
