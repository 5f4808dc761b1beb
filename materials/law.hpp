#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "materials/material_parameters.hpp"
#include "materials/variable.hpp"
#include "tensor/symmetric.hpp"

namespace vitrum {
enum class EventKind { damage, yield, peak, localisation, separation, closure };
inline constexpr std::size_t event_kinds = 6;
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
  std::vector<Event> events;  ///< in the order in which they happened
  Dissipation dissipation;
  SolverCounters solver;
  std::string cause;  ///< not empty: the increment could not be integrated

  bool failed() const { return !cause.empty(); }
  /// Forgets the last increment.
  void clear() { events.clear(), dissipation = {}, solver = {}, cause.clear(); }

  /// Events come in the order in which they happen; what rounding says otherwise is no time.
  void record(EventKind kind, double fraction) {
    if (!events.empty()) fraction = std::max(fraction, events.back().fraction);
    events.push_back({kind, fraction});
  }
};

/// An event of a batch, with the index of its particle.
struct ParticleEvent {
  std::size_t particle;
  Event event;
};

/// Most numbers that a law may store of a point besides the elastic strain.
inline constexpr std::size_t most_columns = 48;

/// One material point as the program sees it: what the variables mean is the law's affair.
struct PointState {
  SymmetricTensor elastic_strain{};
  SymmetricTensor stress{};  ///< Pa; always the law's stress of `elastic_strain` and the variables
  double dissipated = 0.0;   ///< energy dissipated so far, J per m^3 of material
  /// Components of the law's own variables in the order of Material::columns(), without `dissipated`.
  std::array<double, most_columns> variables{};
};

/// Pointers to the columns of a law's variables, in the order of Material::columns(). Copies only as many as
/// there are.
template <class Pointer>
class VariableColumns {
 public:
  VariableColumns() {}  // entries beyond size() are not set
  VariableColumns(const VariableColumns& o) { *this = o; }
  VariableColumns& operator=(const VariableColumns& o) {
    size_ = o.size_;
    std::copy(o.begin(), o.end(), column_);
    return *this;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void push_back(Pointer column) { column_[size_++] = column; }
  void resize(std::size_t size) { size_ = size; }
  Pointer& operator[](std::size_t k) { return column_[k]; }
  Pointer operator[](std::size_t k) const { return column_[k]; }
  Pointer* begin() { return column_; }
  Pointer* end() { return column_ + size_; }
  const Pointer* begin() const { return column_; }
  const Pointer* end() const { return column_ + size_; }

 private:
  std::size_t size_ = 0;
  Pointer column_[most_columns];
};

/// Pointers to the columns of a range of particles (structure of arrays). The state at the start of the
/// increment is only read; that at its end may go to the same columns (the increment is committed) or to
/// others (it is tried).
struct ParticleColumns {
  std::array<const double*, 4> start_strain{};     ///< elastic: rr, zz, tt, rz
  VariableColumns<const double*> start_variables;  ///< as Material::columns()
  std::array<double*, 4> elastic_strain{};         ///< at the end
  std::array<double*, 4> stress{};                 ///< at the end, Pa; null: not wanted
  VariableColumns<double*> variables;              ///< at the end; none: not stored
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

class EventDriven;

/// What Batch appends to the variables of a law that dissipates.
Variable dissipated_variable();

/// One point's constitutive law, as the rest of the program knows it. Pure functions of (state, increment) to
/// (state, stress); a law owns no particle and knows no grid. Laws are written as classes of their own and
/// become materials by `Batch` (materials/batch.hpp).
class Material {
 public:
  virtual ~Material() = default;

  /// As read from the scene.
  const MaterialParameters& parameters() const { return parameters_; }
  /// Of the unstrained material, kg/m^3.
  double density() const { return parameters_.elastic.density; }
  /// The internal variables that this material stores, in output order, and their columns.
  std::span<const Variable> variables() const { return variables_; }
  std::span<const Component> columns() const { return columns_; }
  /// The column called `name`; none where the material has no such variable.
  std::optional<std::size_t> column(std::string_view name) const;
  /// Whether increments may dissipate: the last column is then `dissipated`.
  bool dissipates() const { return dissipates_; }

  /// Speed of plane pressure waves in the virgin material, m/s.
  virtual double wave_speed() const = 0;
  /// Strain at which the material leaves elasticity. A scale for tolerances, not a law.
  virtual double strain_scale() const = 0;
  /// The virgin state under a given stress (Pa), not yet judged.
  virtual PointState start(const SymmetricTensor& stress) const = 0;
  /// What a given state asks for at once, before anything moves (stress outside a yield surface falls onto
  /// it). Sets the stress. The other functions take a state that has been judged, as all that they leave are.
  virtual void judge(PointState& state, PointReport& report) const = 0;
  /// Closed-form response to a strain increment that is linear in time over `duration` seconds (> 0, or 0 for
  /// a jump). The increment is given in the material's own turning frame; the state is not rotated here.
  virtual void advance(PointState& state, const SymmetricTensor& strain_increment, double duration,
                       PointReport& report) const = 0;
  /// The same for particles [begin, end), rotating each result by its spin. `report` is added to. Increments
  /// that stay elastic are taken here; the others by `integrator`, or in closed form when it is null.
  virtual void advance(const ParticleColumns& particles, std::size_t begin, std::size_t end, double duration,
                       PointIntegrator* integrator, BatchReport& report) const = 0;
  /// Columns that `stress` reads; those of the other variables may be null.
  std::span<const std::size_t> stress_columns() const { return stress_columns_; }
  /// Stress of `size` particles, Pa, in columns (rr, zz, tt, rz) as their elastic strain.
  virtual void stress(const std::array<const double*, 4>& elastic_strain,
                      const VariableColumns<const double*>& variables, std::size_t size,
                      const std::array<double*, 4>& stress) const = 0;
  /// Stress of a state, Pa.
  virtual SymmetricTensor stress(const PointState& state) const = 0;
  /// Energy stored per volume of material, J/m^3.
  virtual double stored_energy(const PointState& state) const = 0;
  /// Consistent tangent: d stress(end) / d strain_increment of `advance`, the duration held. 4 x 4 by rows,
  /// in the order (rr, zz, tt, rz), tensor shear (the column of rz counts both shears), in the frame that
  /// turns with the material. Where the response jumps (a snap-back inside the stencil of differences) there
  /// is no derivative, and the secant of the end stands in. Always finite for finite input.
  virtual TangentEntries tangent(const PointState& state, const SymmetricTensor& strain_increment,
                                 double duration) const = 0;
  /// The same for particles [begin, end) whose columns hold the state at the start of the increment.
  virtual void tangent(const ParticleColumns& particles, std::size_t begin, std::size_t end, double duration,
                       TangentEntries* tangents) const = 0;

  /// The column that scalar damage grows with; none: the material has no damage.
  std::optional<std::size_t> damage_column() const { return damage_column_; }
  /// Scalar damage, 0 (whole) to 1, of a value of that column.
  virtual double damage(double value) const { return value; }
  /// The same of a state; 0 without damage.
  double damage(const PointState& state) const {
    return damage_column_ ? damage(state.variables[*damage_column_]) : 0.0;
  }
  /// The same law as an ODE; null: it is taken in closed form under every local method.
  virtual const EventDriven* event_driven() const { return nullptr; }

 protected:
  /// dissipates: `dissipated` is appended to the law's own variables. Throws std::logic_error where they have
  /// more components than a point can hold.
  Material(MaterialParameters parameters, std::vector<Variable> variables, bool dissipates,
           std::vector<std::size_t> stress_columns, std::optional<std::size_t> damage_column);

 private:
  MaterialParameters parameters_;
  std::vector<Variable> variables_;
  std::vector<Component> columns_;
  std::vector<std::size_t> stress_columns_;
  std::optional<std::size_t> damage_column_;
  bool dissipates_;
};

/// The number of a state that stands in column k of the material.
double& value_of(const Material& material, PointState& state, std::size_t k);
double value_of(const Material& material, const PointState& state, std::size_t k);

/// The material that `parameters` names. cell: side of the grid cells, m (for the effective length L_e).
std::shared_ptr<const Material> make_material(const MaterialParameters& parameters, double cell);

}  // namespace vitrum
