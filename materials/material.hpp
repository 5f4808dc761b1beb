#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

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

/// What one increment of one point did besides changing its state.
struct PointReport {
  static constexpr std::size_t capacity = 16;
  std::array<Event, capacity> events{};
  std::size_t event_count = 0;  ///< an increment that fires more keeps the first `capacity`
  Dissipation dissipation;

  void record(EventKind kind, double fraction) {
    if (event_count < capacity) events[event_count++] = {kind, fraction};
  }
};

/// An event of a batch, with the index of its particle.
struct ParticleEvent {
  std::size_t particle;
  Event event;
};

/// Pointers to the columns of a range of particles (structure of arrays); null where the material has no such
/// variable.
struct ParticleColumns {
  std::array<double*, 4> elastic_strain{};          ///< components rr, zz, tt, rz
  std::array<double*, 4> stress{};                  ///< Pa
  std::array<double*, variable_count> variables{};  ///< by Variable
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
  /// State at the start under a given stress (Pa).
  virtual PointState initial_state(const SymmetricTensor& stress) const = 0;
  /// Closed-form response to a strain increment that is linear in time over `duration` seconds (> 0, or 0 for
  /// a jump). The increment is given in the material's own turning frame; the state is not rotated here.
  virtual void respond(PointState& state, const SymmetricTensor& strain_increment, double duration,
                       PointReport& report) const = 0;
  /// The same for particles [begin, end), rotating each result by its spin. `report` is added to.
  virtual void respond(const ParticleColumns& particles, std::size_t begin, std::size_t end, double duration,
                       BatchReport& report) const = 0;
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
