#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <stdexcept>
#include <type_traits>

#include "materials/law_state.hpp"

/// From a law to a material: what is alike for all laws is written here once, and the compiler sees the law.
///
/// A law is a class with
///
///     struct State : LawState { ... };            // its variables by name
///     std::vector<Variable> variables() const;    // their names, units, kinds
///     void members(auto& state, auto&& f) const;  // calls f(variable) for each, in the same order
///     Moduli elastic() const; double strain_scale() const;            // of the virgin material
///     void start(const SymmetricTensor& stress, State& state) const;  // elastic strain under a stress
///     void advance(State&, const SymmetricTensor& strain, double duration, PointReport& report) const;
///     SymmetricTensor stress(const State& state) const;
///     double stored_energy(const State& state) const;
///
/// `advance` changes elastic strain and variables and books dissipation (J/m^3) and events; stress, rotation
/// and the variable `dissipated` are not its affair. It may have
///
///     void judge(State& state, PointReport& report) const;
///     std::optional<std::size_t> damage_column() const; double damage(double value) const;
///     std::optional<std::size_t> leaving_column() const;  // 1 there: the point leaves the computation
///     std::vector<std::size_t> stress_columns() const;  // what stress() reads; absent: all
///     Moduli secant_moduli(const State& state) const;   // where Hooke's law is its tangent
///     const EventDriven* event_driven() const;
///     const std::optional<StrengthScatter>& scatter() const;  // of its strength
///
/// and, for speed, elastic runs (`RunsElastically`): increments that change nothing but the elastic strain
/// are found and taken by loops that are vectorised.
namespace vitrum {

/// Most particles of one vectorised loop.
inline constexpr std::size_t elastic_run = 64;
/// 1 for increments that are more than elastic, else 0 (numbers are vectorised, truth values are not).
using InelasticMarks = std::array<double, elastic_run>;

/// Elastic increments change no variable, and turn none: a law that stores vectors or tensors marks every
/// point where they are not zero (`marks_directions`). Stress and energy may depend on one variable besides
/// the strain, that of the column `elastic_column` (negative: on none).
template <class Law>
concept RunsElastically = requires(const Law& law, const ParticleColumns& p, InelasticMarks& marks,
                                   const SymmetricTensor& strain) {
  { Law::elastic_column } -> std::convertible_to<int>;
  { Law::marks_directions } -> std::convertible_to<bool>;
  { law.mark_inelastic(p, std::size_t{}, std::size_t{}, 0.0, marks) } -> std::same_as<bool>;
  { law.elastic_stress(strain, 0.0) } -> std::same_as<SymmetricTensor>;
  { law.elastic_energy(strain, 0.0) } -> std::same_as<double>;
};

/// Hooke's law as a matrix.
constexpr TangentEntries elastic_entries(const Moduli& m) {
  const double lame = m.bulk - 2.0 / 3.0 * m.shear, p = lame + 2.0 * m.shear;
  return {p, lame, lame, 0.0, lame, p, lame, 0.0, lame, lame, p, 0.0, 0.0, 0.0, 0.0, 2.0 * m.shear};
}

template <class Law>
class Batch final : public Material {
 public:
  using State = typename Law::State;

  Batch(const MaterialParameters& parameters, Law law)
      : Material(parameters, law.variables(), dissipative, stress_columns_of(law), damage_column_of(law)),
        law_(std::move(law)),
        wave_speed_(std::sqrt(law_.elastic().p_wave() / density())) {
    require_described();
  }

  const Law& law() const { return law_; }
  double wave_speed() const override { return wave_speed_; }
  double strain_scale() const override { return law_.strain_scale(); }

  PointState start(const SymmetricTensor& stress) const override {
    State s;
    std::size_t k = 0;
    law_.members(s, [&](auto& member) { fill(member, [&] { return columns()[k++].initial; }); });
    law_.start(stress, s);
    s.stress = stress;
    PointState point;
    store(s, point);
    return point;
  }

  void judge(PointState& point, PointReport& report) const override {
    State s = load(point);
    const double before = report.dissipation.total();
    if constexpr (requires { law_.judge(s, report); }) law_.judge(s, report);
    conclude(s, report.dissipation.total() - before);
    store(s, point);
  }

  void advance(PointState& point, const SymmetricTensor& strain, double duration,
               PointReport& report) const override {
    State s = load(point);
    advance(s, strain, duration, report);
    store(s, point);
  }

  void advance(const ParticleColumns& p, std::size_t begin, std::size_t end, double duration,
               PointIntegrator* integrator, BatchReport& report) const override;

  using Material::stress;
  SymmetricTensor stress(const PointState& point) const override { return law_.stress(load(point)); }
  void stress(const TensorPointers<const double>& elastic_strain,
              const VariableColumns<const double*>& variables, std::size_t size,
              const TensorPointers<double>& stress) const override;
  double stored_energy(const PointState& point) const override { return law_.stored_energy(load(point)); }

  TangentEntries tangent(const PointState& point, const SymmetricTensor& strain,
                         double duration) const override {
    return tangent(load(point), strain, duration);
  }
  void tangent(const ParticleColumns& p, std::size_t begin, std::size_t end, double duration,
               TangentEntries* tangents) const override;

  using Material::damage;
  double damage(double value) const override {
    if constexpr (requires { law_.damage(value); })
      return law_.damage(value);
    else
      return value;
  }
  std::optional<std::size_t> leaving_column() const override {
    if constexpr (requires { law_.leaving_column(); })
      return law_.leaving_column();
    else
      return std::nullopt;
  }
  const StrengthScatter* scatter() const override {
    if constexpr (requires { law_.scatter(); })
      return law_.scatter() ? &*law_.scatter() : nullptr;
    else
      return nullptr;
  }
  const EventDriven* event_driven() const override {
    if constexpr (requires { law_.event_driven(); })
      return law_.event_driven();
    else
      return nullptr;
  }

 private:
  static constexpr bool runs = RunsElastically<Law>;
  /// Whether Hooke's law of the state is its elastic tangent.
  static constexpr bool hookean = requires(const Law& law, const State& s) { law.secant_moduli(s); };
  static constexpr bool dissipative = [] {
    if constexpr (requires { Law::dissipates; })
      return Law::dissipates;
    else
      return true;
  }();

  static Kind kind_of(double) { return Kind::scalar; }
  static Kind kind_of(const PlaneVector&) { return Kind::vector; }
  static Kind kind_of(const SymmetricTensor&) { return Kind::symmetric; }
  /// Throws std::logic_error where what the law stores is not what it says that it stores.
  void require_described() const {
    const std::vector<Variable> described = law_.variables();
    std::size_t n = 0;
    bool same = true;
    const State s;
    law_.members(s, [&](const auto& member) {
      same = same && n < described.size() && described[n].kind == kind_of(member);
      ++n;
    });
    if constexpr (runs)
      for (const Variable& v : described) same = same && (v.kind == Kind::scalar || Law::marks_directions);
    if (!same || n != described.size())
      throw std::logic_error("material '" + parameters().name +
                             "': its variables are not those of its state");
  }

  static std::vector<std::size_t> stress_columns_of(const Law& law) {
    if constexpr (requires { law.stress_columns(); }) {
      return law.stress_columns();
    } else if constexpr (runs) {
      return Law::elastic_column < 0 ? std::vector<std::size_t>{}
                                     : std::vector{static_cast<std::size_t>(Law::elastic_column)};
    } else {
      std::vector<std::size_t> all(components_of(law.variables()).size());
      for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
      return all;
    }
  }
  static std::optional<std::size_t> damage_column_of(const Law& law) {
    if constexpr (requires { law.damage_column(); })
      return law.damage_column();
    else
      return std::nullopt;
  }

  State load(const PointState& point) const { return load_state(law_, point); }
  void store(const State& s, PointState& point) const { store_state(law_, s, point); }
  /// The same with particle i of the columns, without the stress.
  void load(const ParticleColumns& p, std::size_t i, State& s) const {
    s.elastic_strain = tensor_at(p.start_strain, i);
    std::size_t k = 0;
    law_.members(s, [&](auto& member) VITRUM_INLINE_LAMBDA {
      fill(member, [&]() VITRUM_INLINE_LAMBDA { return p.start_variables[k++][i]; });
    });
    if constexpr (dissipative) s.dissipated = p.start_variables[k][i];
  }
  void load(const ParticleColumns& p, std::size_t i, PointState& point) const {
    point.elastic_strain = tensor_at(p.start_strain, i);
    const std::size_t own = p.start_variables.size() - (dissipative ? 1 : 0);
    for (std::size_t k = 0; k < own; ++k) point.variables[k] = p.start_variables[k][i];
    if constexpr (dissipative) point.dissipated = p.start_variables[own][i];
  }
  void store_variables(const State& s, const ParticleColumns& p, std::size_t i) const {
    if (p.variables.empty()) return;
    std::size_t k = 0;
    law_.members(s, [&](const auto& member) VITRUM_INLINE_LAMBDA {
      hand_over(member, [&](double v) VITRUM_INLINE_LAMBDA { p.variables[k++][i] = v; });
    });
    if constexpr (dissipative) p.variables[k][i] = s.dissipated;
  }

  void conclude(State& s, double dissipation) const {
    s.stress = law_.stress(s);
    s.dissipated += dissipation;
  }
  void advance(State& s, const SymmetricTensor& strain, double duration, PointReport& report) const {
    const double before = report.dissipation.total();
    law_.advance(s, strain, duration, report);
    conclude(s, report.dissipation.total() - before);
  }

  bool stays_elastic(const State& s, const SymmetricTensor& strain, double duration) const;
  TangentEntries tangent(const State& start, const SymmetricTensor& strain, double duration) const;
  TangentEntries tangent_by_differences(const State& start, const SymmetricTensor& strain,
                                        double duration) const;
  template <bool small>
  double take_elastic_turning(const ParticleColumns& p, std::size_t begin, std::size_t end) const;
  void stress_of_each(const TensorPointers<const double>& strain,
                      const VariableColumns<const double*>& variables, std::size_t size,
                      const TensorPointers<double>& stress) const;
  void store_elastic_stress(const ParticleColumns& p, std::size_t begin, std::size_t end) const;
  double take_elastic(const ParticleColumns& p, std::size_t begin, std::size_t end) const;
  /// What increments of one point need, made once for many.
  struct Room {
    State state;
    PointState point;
    PointReport report;
  };
  double take_inelastic(const ParticleColumns& p, std::size_t i, Room& room, double duration,
                        PointIntegrator* integrator, BatchReport& report) const;

  Law law_;
  double wave_speed_;
};

}  // namespace vitrum

#include "materials/batch_increments.hpp"
#include "materials/batch_tangent.hpp"
