#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "materials/evolution.hpp"
#include "materials/material_parameters.hpp"
#include "materials/point_state.hpp"

namespace vitrum {

enum class EventKind { damage, yield, peak, localisation, separation, closure };
std::string_view event_name(EventKind kind);

/// Something that happened inside an increment, at `fraction` in [0, 1] of it.
struct Event {
  EventKind kind;
  double fraction;
};

/// Energy turned into heat and surface by an increment, J per m^3 of material. `snap_back` is the part of
/// `fracture` that an instantaneous release dissipated beyond what the traction-opening relation of eq. 13
/// asks for.
struct Dissipation {
  double plastic = 0.0, damage = 0.0, fracture = 0.0, snap_back = 0.0;

  constexpr double total() const { return plastic + damage + fracture; }
  constexpr Dissipation& operator+=(const Dissipation& o) {
    plastic += o.plastic, damage += o.damage, fracture += o.fracture, snap_back += o.snap_back;
    return *this;
  }
};

/// Work of ODE solvers. Zero for closed-form responses.
struct SolverCounters {
  std::int64_t increments = 0;  ///< that reached a solver
  std::int64_t solves = 0;      ///< modes integrated
  std::int64_t steps = 0, right_hand_sides = 0;
  std::int64_t failures = 0;  ///< attempts that failed and were repeated by other means

  constexpr SolverCounters& operator+=(const SolverCounters& o) {
    increments += o.increments, solves += o.solves, steps += o.steps;
    right_hand_sides += o.right_hand_sides, failures += o.failures;
    return *this;
  }
};

/// What one increment of one point did besides changing its state.
struct PointReport {
  static constexpr std::size_t capacity = 16;
  std::array<Event, capacity> events{};
  std::size_t event_count = 0;  ///< an increment that fires more keeps the first `capacity`
  Dissipation dissipation;
  SolverCounters solver;
  std::string cause;  ///< not empty: the increment could not be integrated

  bool failed() const { return !cause.empty(); }
  /// Forgets the last increment.
  void clear() { event_count = 0, dissipation = {}, solver = {}, cause.clear(); }

  /// Events come in the order in which they happen; what rounding says otherwise is no time.
  void record(EventKind kind, double fraction) {
    if (event_count == capacity) return;
    if (event_count > 0) fraction = std::max(fraction, events[event_count - 1].fraction);
    events[event_count++] = {kind, fraction};
  }
};

/// An event of a batch, with the index of its particle.
struct ParticleEvent {
  std::size_t particle;
  Event event;
};

/// Pointers to the columns of a range of particles (structure of arrays). The state at the start of the
/// increment is only read; that at its end may go to the same columns (the increment is committed) or to
/// others (it is tried).
struct ParticleColumns {
  std::array<const double*, 4> start_strain{};                  ///< elastic: rr, zz, tt, rz
  std::array<const double*, variable_count> start_variables{};  ///< by Variable; null: the material has none
  std::array<double*, 4> elastic_strain{};                      ///< at the end
  std::array<double*, 4> stress{};                              ///< at the end, Pa; null: not wanted
  std::array<double*, variable_count> variables{};              ///< at the end; null: not stored
  std::array<const double*, 4>
      strain_increment{};                  ///< in the frame that turns with the particle (corotational)
  const double* spin_increment = nullptr;  ///< rad, counter-clockwise from r to z
  const double* mass = nullptr;            ///< kg (per radian or per metre)
};

/// Sums over a range of particles, joules (per radian or per metre).
struct BatchReport {
  double elastic = 0.0;    ///< stored energy at the end of the increment
  Dissipation dissipated;  ///< joules here, not J/m^3
  std::vector<ParticleEvent> events;
  SolverCounters solver;
  /// The first particle whose increment could not be integrated; its state is left as before the increment.
  std::optional<std::size_t> failed;
  SymmetricTensor failed_increment;  ///< strain increment of that failure
  std::string cause;                 ///< of that failure

  /// Whether it tells of anything but elastic energy.
  bool tells_more() const {
    return dissipated.total() != 0.0 || dissipated.snap_back != 0.0 || !events.empty() ||
           solver.increments != 0 || failed.has_value();
  }

  /// Back to zero; keeps its memory.
  void clear() {
    elastic = 0.0, dissipated = {}, solver = {};
    events.clear(), failed.reset(), cause.clear();
  }
};

class Material;

/// How the increments that are not elastic are taken. Implemented by the local integrators.
class PointIntegrator {
 public:
  virtual ~PointIntegrator() = default;
  /// Takes one point over a strain increment of `duration` seconds. On failure report.cause says why, and the
  /// state is of no use.
  virtual void integrate(const Material& material, PointState& state, const SymmetricTensor& strain_increment,
                         double duration, PointReport& report) = 0;
};

/// A tangent by rows: entry (i, j) is [4 i + j].
using TangentEntries = std::array<double, 16>;

/// One point's constitutive law: isotropic elasticity + optional damage + optional plasticity + optional
/// decohesion. Pure functions of (state, increment) to (state, stress); a material owns no particle and knows
/// no grid.
class Material {
 public:
  virtual ~Material() = default;

  virtual const MaterialParameters& parameters() const = 0;
  /// The internal variables that this material stores, in output order.
  virtual std::span<const VariableInfo> variables() const = 0;
  /// Speed of plane pressure waves in the undamaged material, m/s.
  virtual double wave_speed() const = 0;
  /// The undamaged state under a given stress (Pa), not yet judged.
  virtual PointState initial_state(const SymmetricTensor& stress) const = 0;
  /// What a given state asks for at once, before anything moves: tension the damage of eq. 7 at `rate_floor`
  /// (or the state's larger rate) up to the onset of localisation, stress outside the yield surface its fall,
  /// a plane that bears too much its opening. Sets the stress. The other functions take a state that has been
  /// judged, as all that they leave are.
  virtual void judge(PointState& state, PointReport& report) const = 0;
  /// Closed-form response to a strain increment that is linear in time over `duration` seconds (> 0, or 0 for
  /// a jump). The increment is given in the material's own turning frame; the state is not rotated here.
  virtual void respond(PointState& state, const SymmetricTensor& strain_increment, double duration,
                       PointReport& report) const = 0;
  /// The same for particles [begin, end), rotating each result by its spin. `report` is added to. Increments
  /// that stay elastic are taken here; the others by `integrator`, or in closed form when it is null.
  virtual void respond(const ParticleColumns& particles, std::size_t begin, std::size_t end, double duration,
                       PointIntegrator* integrator, BatchReport& report) const = 0;

  // The same law as an ODE (evolution.hpp).
  /// The mode at the start of a path. Performs the jumps that the state asks for (snap-back, excess shear)
  /// and books them.
  virtual EvolutionMode enter(PointState& state, const StrainPath& path, PointReport& report) const = 0;
  /// The mode after `root` ended `mode` at `fraction` of the path; performs the jumps and records the event.
  virtual void leave(EvolutionMode& mode, Root root, PointState& state, const StrainPath& path,
                     double fraction, PointReport& report) const = 0;
  virtual EvolutionRates rates(const EvolutionMode& mode, const PointState& state,
                               const StrainPath& path) const = 0;
  /// d(rates)/d(state) of a plane that decoheres with a viscosity, without plastic flow.
  virtual OpeningJacobian opening_jacobian(const EvolutionMode& mode, const PointState& state,
                                           const StrainPath& path) const = 0;
  /// Event functions of the mode.
  virtual void events(const EvolutionMode& mode, const PointState& state, const StrainPath& path,
                      EventFunctions& functions) const = 0;
  /// Drift correction: puts a state that was integrated with errors back onto the yield surface, the strength
  /// of the plane, and traction-free faces.
  virtual void settle(const EvolutionMode& mode, PointState& state, const StrainPath& path) const = 0;
  /// Consistent tangent: d stress(end) / d strain_increment of `respond`, the duration held. 4 x 4 by rows,
  /// order and shear convention as in materials/tangent.hpp, in the frame that turns with the material. Where
  /// the response jumps (a snap-back inside the stencil of differences) there is no derivative, and the
  /// secant of the end stands in. Always finite for finite input.
  virtual TangentEntries tangent(const PointState& state, const SymmetricTensor& strain_increment,
                                 double duration) const = 0;
  /// The same for particles [begin, end) whose columns hold the state at the start of the increment.
  virtual void tangent(const ParticleColumns& particles, std::size_t begin, std::size_t end, double duration,
                       TangentEntries* tangents) const = 0;
  /// Moduli that give the stress of a state (damaged bulk modulus only under tension).
  virtual Moduli secant_moduli(const PointState& state) const = 0;
  /// Stress of `size` particles, Pa: Hooke's law of their elastic strain (both rr, zz, tt, rz) with these
  /// moduli. crack_density: null where the material has no damage.
  virtual void stress(const std::array<const double*, 4>& elastic_strain, const double* crack_density,
                      std::size_t size, const std::array<double*, 4>& stress) const = 0;
  /// Scalar damage D of eq. 8 (0 without a damage model).
  virtual double damage(const PointState& state) const = 0;
  /// Energy stored per volume of material, J/m^3.
  double stored_energy(const PointState& state) const {
    return secant_moduli(state).energy(state.elastic_strain);
  }
};

/// Composes the models that `parameters` names. cell: side of the grid cells, m (for the effective length
/// L_e).
std::shared_ptr<const Material> make_material(const MaterialParameters& parameters, double cell);

}  // namespace vitrum
