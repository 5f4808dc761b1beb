#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "materials/material_parameters.hpp"
#include "materials/particle_columns.hpp"
#include "materials/report.hpp"
#include "materials/scatter.hpp"
#include "materials/variable.hpp"

namespace vitrum {

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
  virtual void stress(const TensorPointers<const double>& elastic_strain,
                      const VariableColumns<const double*>& variables, std::size_t size,
                      const TensorPointers<double>& stress) const = 0;
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
  /// The column that says by 1 that a point is to leave the computation: it bears nothing, whatever comes.
  /// None: points stay.
  virtual std::optional<std::size_t> leaving_column() const { return std::nullopt; }
  /// How its strength scatters: by `strength_factor`, the last of its variables, which whoever makes a point
  /// draws; null: not.
  virtual const StrengthScatter* scatter() const { return nullptr; }
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
