#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "integrators/grid/grid_integrator.hpp"
#include "observe/bodies.hpp"
#include "observe/energy_totals.hpp"
#include "observe/failure_report.hpp"
#include "output/provenance.hpp"

namespace vitrum::output {

enum class RunStatus { complete, failed, interrupted };

/// One body at the end of a run (axisymmetric: the whole body; plane strain: per metre).
struct BodySummary {
  std::string name;
  std::size_t particles = 0;
  BodyMotion motion;
  FailureMeasures failure;
  /// Particles that have left, and their mass, kg; none: none can.
  std::optional<std::pair<std::size_t, double>> removed = std::nullopt;
};

/// What has passed between two bodies (axisymmetric: whole bodies; plane strain: per metre).
struct ContactSummary {
  std::array<std::string, 2> bodies;
  std::array<double, 2> impulse{};  ///< N s, on the first
  double friction_work = 0.0;       ///< J
  double least_gap = 0.0;  ///< m; negative: penetration; infinite: they were never opposite each other
};

/// What summary.json tells. Energies arrive as they are to be written (axisymmetric: joules of the whole
/// body).
struct RunSummary {
  RunStatus status = RunStatus::complete;
  std::string message;                ///< why not complete; empty: null in the file
  std::vector<std::string> warnings;  ///< told before the run and at its end
  double time = 0.0;                  ///< s, reached
  std::size_t particles = 0;
  double wall_seconds = 0.0;   ///< of the time loop alone
  double total_seconds = 0.0;  ///< of the whole process, outputs and all
  int threads = 1;
  std::string integrator_method, constitutive_method;  ///< by their scene names
  IntegratorCounters integrator;
  std::optional<ErrorEstimate> error;  ///< none: the method makes no estimate
  std::int64_t phases = 0;             ///< arkode-implicit
  double remap_loss = 0.0;             ///< J, arkode-implicit
  ConstitutiveCounters constitutive;
  EnergyTotals energy;
  double ringing = 0.0;  ///< J, of pressures that differ from their average over cells, at the end
  FailureReport failure;
  std::vector<BodySummary> bodies;
  std::vector<ContactSummary> contacts;  ///< by pair, where bodies have contact
  Provenance provenance;
};

/// Fragments listed one by one; their number and masses count all of them.
inline constexpr std::size_t listed_fragments = 100;

/// The keys of docs/reference/result.md in its order. What did not happen, and every number that is not
/// finite, is null.
nlohmann::ordered_json to_json(const RunSummary& summary);

/// Writes the JSON atomically. Throws FileError.
void write_summary(const std::filesystem::path& path, const RunSummary& summary);

}  // namespace vitrum::output
