#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "integrators/grid/critical_step.hpp"
#include "mpm/system.hpp"
#include "scene/scene.hpp"
#include "scene/scene_size.hpp"

namespace vitrum::app {

/// Particles whose increments a thread takes in a second, about (the reference case, closed form, release
/// build: 3.4e6 to 9e6). Newton iterations take longer, and so do error-controlled local methods where
/// increments are not elastic.
inline constexpr double particle_steps_a_second = 4.0e6;
/// Beyond it a run is refused: no one would see its end.
inline constexpr double longest_run = 365.25 * 86400.0;
/// Beyond it a run is warned of.
inline constexpr double long_run = 86400.0;

/// Throws InputError when a scene takes more memory than is available: with the estimate, the place, and what
/// to change. To be asked before the scene's system is built.
void require_memory(const Scene& scene, const SceneSize& size);

/// The key that sets the length of steps.
std::string step_key(const IntegratorDefinition& integrator);

/// What the time loop takes.
struct Work {
  double steps = 0.0;        ///< planned; adaptive methods: no fewer
  bool is_planned = false;   ///< not just a lower bound
  double evaluations = 0.0;  ///< of all particles
  double seconds = 0.0;      ///< about; with an error-controlled local method: while increments are elastic
};
/// threads: used.
Work work_of(const Scene& scene, const System& system, int threads);

/// The same if no increment is elastic (local_cost.hpp: measured now), s.
double most_seconds(const Scene& scene, const System& system, const Work& work, int threads);

/// What the outputs take besides, with all fields, s: 3 ms each and 1 us a particle, about (the reference
/// case on cells of 2.5 to 0.25 mm).
double output_seconds(const Scene& scene, const System& system);

/// Throws InputError when a run would take longer than longest_run.
void require_time(const Scene& scene, const System& system, const Work& work, int threads);

/// Throws InputError when times are so far from 0 that their last digit is not small beside a step.
void require_clock(const Scene& scene, const System& system);

/// Bytes of the files that a run leaves, and of those in the making.
double disk_space_of(const Scene& scene, const System& system, bool with_fields);

/// Throws InputError when the files of a run do not fit into its folder, where those of an earlier run make
/// room.
void require_disk(const Scene& scene, double bytes, const std::filesystem::path& folder);

/// The critical step of the scene's method: of an explicit scheme, of an explicit Butcher table, or (for
/// comparison: an implicit method has none) that of MUSL. All bodies with contact are taken to touch.
CriticalStep critical_step_of(const IntegratorDefinition& integrator, const System& system);

/// "; contact with 'NAME' is stiffer than the grid", where it is what sets the critical step.
std::string contact_text(const CriticalStep& critical);

/// The step that the scene fixes; none where it adapts to the error.
std::optional<double> planned_step(const IntegratorDefinition& integrator, const CriticalStep& critical);

/// "3.2 GB", "5.1 h".
std::string bytes_text(double bytes);
std::string duration_text(double seconds);

}  // namespace vitrum::app
