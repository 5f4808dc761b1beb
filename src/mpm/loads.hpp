#pragma once
#include "mpm/system.hpp"

/// Loads that vary: what of them stands in the system at a time. Nothing else evaluates their functions.
namespace vitrum::mpm {

/// Whether gravity acts, now or at another time.
bool has_gravity(const System& system);
/// Whether some boundary's velocity varies.
bool drives(const System& system);

/// For an explicit step from the present time on. Its velocities stand half a step before its positions:
/// those of boundaries become those in the middle of the step, from half a step before; gravity is that of
/// the start.
void set_loads_of_step(System& system, double duration);
/// For a state at `time` (s). until: no kink lies between the present and this time (s). accelerations: whether
/// boundaries have them; else particles take a change of velocity otherwise.
enum class Accelerations { taken, none };
void set_loads(System& system, double time, double until, Accelerations accelerations);

/// Two components of each boundary: its present velocity (m/s), its way between two times (m).
using OfBoundaries = std::vector<std::array<double, 2>>;
OfBoundaries boundary_velocities(const System& system);
OfBoundaries boundary_ways(const System& system, double from, double to);

/// The first time after the present at which a boundary comes to hold other nodes, or a rate may jump;
/// infinite: never. No adaptive step goes over it.
double next_load_change(const System& system);

}  // namespace vitrum::mpm
