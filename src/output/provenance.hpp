#pragma once
#include <array>
#include <string>
#include <string_view>

namespace vitrum::output {

/// How a result was made. All texts.
struct Provenance {
  std::string version;   ///< of vitrum
  std::string git;       ///< commit that was built, "-dirty" when changed; "unknown" outside a repository
  std::string command;   ///< the command line
  std::string sundials;  ///< version of the library
  std::string compiler;  ///< with version and kind of build
  std::string host;
  std::string started;       ///< UTC, ISO 8601: 2026-01-31T12:00:00Z
  std::string scene_sha256;  ///< of the resolved scene's text
};

struct ProvenanceEntry {
  std::string_view name;
  std::string Provenance::*member;
};
/// Every entry, under the names that files use.
inline constexpr std::array<ProvenanceEntry, 8> provenance_entries = {{
    {"version", &Provenance::version},
    {"git", &Provenance::git},
    {"command", &Provenance::command},
    {"sundials", &Provenance::sundials},
    {"compiler", &Provenance::compiler},
    {"host", &Provenance::host},
    {"started", &Provenance::started},
    {"scene_sha256", &Provenance::scene_sha256},
}};

/// Name of this machine.
std::string host_name();
/// UTC, ISO 8601.
std::string utc_now();

/// Provenance of a run that starts now, on this machine, with this build.
Provenance make_provenance(std::string command, std::string scene_sha256);

/// What `vitrum --version` prints: vitrum, git hash, compiler, and every library with its version, a line
/// each.
std::string version_text();

}  // namespace vitrum::output
