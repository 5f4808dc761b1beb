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
///     struct State : LawState { ... };          // its variables by name: double, PlaneVector,
///     SymmetricTensor std::vector<Variable> variables() const;  // their names, units, kinds void
///     members(auto& state, auto&& f) const;  // calls f(variable) for each, in the same order Moduli
///     elastic() const;                   // of the virgin material: speed of waves, tangents double
///     strain_scale() const; void start(const SymmetricTensor& stress, State& state) const;  // elastic
///     strain under a given stress void advance(State& state, const SymmetricTensor& strain, double duration,
///     PointReport& report) const; SymmetricTensor stress(const State& state) const; double
///     stored_energy(const State& state) const;
///
/// `advance` changes elastic strain and variables and books dissipation (J/m^3) and events; stress, rotation
/// and the variable `dissipated` are not its affair. It may have
///
///     void judge(State& state, PointReport& report) const;
///     std::optional<std::size_t> damage_column() const; double damage(double value) const;
///     std::vector<std::size_t> stress_columns() const;  // what stress() reads; absent: all
///     Moduli secant_moduli(const State& state) const;   // Hooke's law of the state, where that is its
///     tangent const EventDriven* event_driven() const;
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
  void stress(const std::array<const double*, 4>& elastic_strain,
              const VariableColumns<const double*>& variables, std::size_t size,
              const std::array<double*, 4>& stress) const override;
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
    if constexpr (runs) {
      return Law::elastic_column < 0 ? std::vector<std::size_t>{}
                                     : std::vector{static_cast<std::size_t>(Law::elastic_column)};
    } else if constexpr (requires { law.stress_columns(); }) {
      return law.stress_columns();
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
    s.elastic_strain = {p.start_strain[0][i], p.start_strain[1][i], p.start_strain[2][i],
                        p.start_strain[3][i]};
    std::size_t k = 0;
    law_.members(s, [&](auto& member) VITRUM_INLINE_LAMBDA {
      fill(member, [&]() VITRUM_INLINE_LAMBDA { return p.start_variables[k++][i]; });
    });
    if constexpr (dissipative) s.dissipated = p.start_variables[k][i];
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
  void store_elastic_stress(const ParticleColumns& p, std::size_t begin, std::size_t end) const;
  double take_elastic(const ParticleColumns& p, std::size_t begin, std::size_t end) const;
  double take_inelastic(const ParticleColumns& p, std::size_t i, State& s, double duration,
                        PointIntegrator* integrator, PointReport& point, BatchReport& report) const;

  Law law_;
  double wave_speed_;
};

/// Increments that stay elastic of particles [begin, end), at most elastic_run of them: the elastic law and
/// the rotation by the spin. Returns the energy they store, J. Written to be vectorised: most particles of
/// most steps pass here.
template <class Law>
template <bool small>
double Batch<Law>::take_elastic_turning(const ParticleColumns& p, std::size_t begin, std::size_t end) const {
  const double *a0 = p.start_strain[0], *a1 = p.start_strain[1], *a2 = p.start_strain[2],
               *a3 = p.start_strain[3];
  const double *d0 = p.strain_increment[0], *d1 = p.strain_increment[1], *d2 = p.strain_increment[2],
               *d3 = p.strain_increment[3], *spin = p.spin_increment, *mass = p.mass;
  const double* variable = mass;  // any, where none is read
  if constexpr (Law::elastic_column >= 0) variable = p.start_variables[Law::elastic_column];
  double *e0 = p.elastic_strain[0], *e1 = p.elastic_strain[1], *e2 = p.elastic_strain[2],
         *e3 = p.elastic_strain[3];
  const double specific_volume = 1.0 / density();
  double energies[elastic_run];  // summed apart: a sum in the loop would have to keep its order
#pragma GCC ivdep
  for (std::size_t i = begin; i < end; ++i) {
    const SymmetricTensor e = rotate({a0[i] + d0[i], a1[i] + d1[i], a2[i] + d2[i], a3[i] + d3[i]},
                                     small ? rotation_by_small(spin[i]) : rotation_by(spin[i]));
    const double stored = law_.elastic_energy(e, variable[i]);
    e0[i] = e.rr, e1[i] = e.zz, e2[i] = e.tt, e3[i] = e.rz;
    energies[i - begin] = mass[i] * specific_volume * stored;
  }
  double stored = 0.0;
#pragma omp simd reduction(+ : stored)
  for (std::size_t k = 0; k < end - begin; ++k) stored += energies[k];
  return stored;
}

/// Stress at the end of increments that stayed elastic.
template <class Law>
void Batch<Law>::store_elastic_stress(const ParticleColumns& p, std::size_t begin, std::size_t end) const {
  std::array<const double*, 4> strain{};
  std::array<double*, 4> to{};
  for (std::size_t c = 0; c < 4; ++c) strain[c] = p.elastic_strain[c] + begin, to[c] = p.stress[c] + begin;
  VariableColumns<const double*> variables = p.start_variables;
  for (const double*& column : variables) column += begin;
  stress(strain, variables, end - begin, to);
}

template <class Law>
double Batch<Law>::take_elastic(const ParticleColumns& p, std::size_t begin, std::size_t end) const {
  const double* spin = p.spin_increment;
  double stored = 0.0;
  for (std::size_t first = begin; first < end; first += elastic_run) {
    const std::size_t last = std::min(end, first + elastic_run);
    double largest = 0.0;
#pragma omp simd reduction(max : largest)
    for (std::size_t i = first; i < last; ++i) largest = std::max(largest, std::abs(spin[i]));
    stored += largest <= small_angle ? take_elastic_turning<true>(p, first, last)
                                     : take_elastic_turning<false>(p, first, last);
    if (p.stress[0] != nullptr) store_elastic_stress(p, first, last);
  }
  return stored;
}

/// An increment that is more than elastic. Returns the energy stored at its end, J.
template <class Law>
double Batch<Law>::take_inelastic(const ParticleColumns& p, std::size_t i, State& s, double duration,
                                  PointIntegrator* integrator, PointReport& point,
                                  BatchReport& report) const {
  const SymmetricTensor strain{p.strain_increment[0][i], p.strain_increment[1][i], p.strain_increment[2][i],
                               p.strain_increment[3][i]};
  point.clear();
  if (integrator == nullptr) {
    advance(s, strain, duration, point);
  } else {
    PointState state;
    store(s, state);
    integrator->integrate(*this, state, strain, duration, point);
    report.solver += point.solver;
    if (!point.failed()) s = load(state);
  }
  if (point.failed()) {
    report.failed = i, report.failed_increment = strain, report.cause = point.cause;
    return 0.0;
  }
  const Rotation by = rotation_by(p.spin_increment[i]);
  s.elastic_strain = rotate(s.elastic_strain, by);
  law_.members(s, [&](auto& member) VITRUM_INLINE_LAMBDA { turn(member, by); });
  store_variables(s, p, i);
  const double volume = p.mass[i] / density();
  report.dissipated.plastic += volume * point.dissipation.plastic;
  report.dissipated.damage += volume * point.dissipation.damage;
  report.dissipated.fracture += volume * point.dissipation.fracture;
  report.dissipated.snap_back += volume * point.dissipation.snap_back;
  for (const Event& event : point.events) report.events.push_back({i, event});
  const SymmetricTensor& e = s.elastic_strain;
  p.elastic_strain[0][i] = e.rr, p.elastic_strain[1][i] = e.zz, p.elastic_strain[2][i] = e.tt,
  p.elastic_strain[3][i] = e.rz;
  if (p.stress[0] != nullptr) {
    const SymmetricTensor stress = law_.stress(s);
    p.stress[0][i] = stress.rr, p.stress[1][i] = stress.zz, p.stress[2][i] = stress.tt,
    p.stress[3][i] = stress.rz;
  }
  return volume * law_.stored_energy(s);
}

template <class Law>
void Batch<Law>::advance(const ParticleColumns& p, std::size_t begin, std::size_t end, double duration,
                         PointIntegrator* integrator, BatchReport& report) const {
  if constexpr (runs && !dissipative) {
    report.elastic += take_elastic(p, begin, end);
    return;
  }
  double stored = 0.0;
  State s;
  PointReport point;
  if constexpr (runs) {
    // Runs of elastic increments between the others.
    std::size_t elastic_from = begin;
    InelasticMarks inelastic;
    for (std::size_t first = begin; first < end; first += elastic_run) {
      const std::size_t last = std::min(end, first + elastic_run);
      if (!law_.mark_inelastic(p, first, last, duration, inelastic)) continue;
      for (std::size_t i = first; i < last; ++i) {
        if (inelastic[i - first] == 0.0) continue;
        load(p, i, s);
        stored += take_elastic(p, elastic_from, i);
        stored += take_inelastic(p, i, s, duration, integrator, point, report);
        if (report.failed) return;  // the step fails, whatever comes after
        elastic_from = i + 1;
      }
    }
    stored += take_elastic(p, elastic_from, end);
  } else {
    for (std::size_t i = begin; i < end; ++i) {
      load(p, i, s);
      stored += take_inelastic(p, i, s, duration, integrator, point, report);
      if (report.failed) return;
    }
  }
  report.elastic += stored;
}

template <class Law>
void Batch<Law>::stress(const std::array<const double*, 4>& strain,
                        const VariableColumns<const double*>& variables, std::size_t size,
                        const std::array<double*, 4>& stress) const {
  const auto [e0, e1, e2, e3] = strain;
  const auto [s0, s1, s2, s3] = stress;
  if constexpr (runs) {
    const double* variable = e0;  // any, where none is read
    if constexpr (Law::elastic_column >= 0) variable = variables[Law::elastic_column];
#pragma GCC ivdep
    for (std::size_t k = 0; k < size; ++k) {
      const SymmetricTensor s = law_.elastic_stress({e0[k], e1[k], e2[k], e3[k]}, variable[k]);
      s0[k] = s.rr, s1[k] = s.zz, s2[k] = s.tt, s3[k] = s.rz;
    }
  } else {
    PointState point;
    for (std::size_t k = 0; k < size; ++k) {
      point.elastic_strain = {e0[k], e1[k], e2[k], e3[k]};
      for (const std::size_t c : stress_columns()) point.variables[c] = variables[c][k];
      const SymmetricTensor s = law_.stress(load(point));
      s0[k] = s.rr, s1[k] = s.zz, s2[k] = s.tt, s3[k] = s.rz;
    }
  }
}

/// Whether one increment stays elastic.
template <class Law>
bool Batch<Law>::stays_elastic(const State& s, const SymmetricTensor& strain, double duration) const {
  if constexpr (!dissipative) return true;
  if constexpr (runs) {
    PointState point;
    store(s, point);
    ParticleColumns one;
    const SymmetricTensor& e = s.elastic_strain;
    one.start_strain = {&e.rr, &e.zz, &e.tt, &e.rz};
    one.strain_increment = {&strain.rr, &strain.zz, &strain.tt, &strain.rz};
    for (std::size_t k = 0; k < columns().size(); ++k) one.start_variables.push_back(&point.variables[k]);
    InelasticMarks marks;
    return !law_.mark_inelastic(one, 0, 1, duration, marks);
  }
  return false;
}

template <class Law>
TangentEntries Batch<Law>::tangent(const State& start, const SymmetricTensor& strain, double duration) const {
  if constexpr (hookean) {
    if (stays_elastic(start, strain, duration)) {
      State end = start;
      end.elastic_strain += strain;
      return elastic_entries(law_.secant_moduli(end));
    }
  }
  return tangent_by_differences(start, strain, duration);
}

template <class Law>
TangentEntries Batch<Law>::tangent_by_differences(const State& start, const SymmetricTensor& strain,
                                                  double duration) const {
  const auto end_after = [&](const SymmetricTensor& increment) {
    State s = start;
    PointReport report;
    advance(s, increment, duration, report);
    return s;
  };
  // Central differences: the average of both sides at a kink.
  const auto differences = [&](double step, double& largest) {
    TangentEntries T{};
    largest = 0.0;
    for (std::size_t column = 0; column < 4; ++column) {
      SymmetricTensor shift{};
      (column == 0 ? shift.rr : column == 1 ? shift.zz : column == 2 ? shift.tt : shift.rz) = step;
      const SymmetricTensor change =
          (0.5 / step) * (end_after(strain + shift).stress - end_after(strain - shift).stress);
      T[column] = change.rr, T[4 + column] = change.zz, T[8 + column] = change.tt, T[12 + column] = change.rz;
      const double size = norm(change);
      largest = size <= largest ? largest : size;  // keeps what is not a number
    }
    return T;
  };
  // The step is far above what rounding leaves of the stress, far below the strains over which the laws
  // change.
  constexpr double relative_step = 1e-6, least_strain = 1e-9, steadiness = 0.1;
  const double step = relative_step * std::max({norm(start.elastic_strain), norm(strain), least_strain});
  double largest = 0.0, nearer = 0.0;
  const TangentEntries T = differences(step, largest);
  if (largest <= 2.0 * law_.elastic().p_wave()) return T;
  // So steep is growing damage, which keeps its slope in a quarter of the stencil, or a jump, which does not.
  differences(0.25 * step, nearer);
  if (std::abs(nearer - largest) <= steadiness * largest) return T;
  if constexpr (hookean)
    return elastic_entries(law_.secant_moduli(end_after(strain)));
  else
    return elastic_entries(law_.elastic());
}

template <class Law>
void Batch<Law>::tangent(const ParticleColumns& p, std::size_t begin, std::size_t end, double duration,
                         TangentEntries* tangents) const {
  State s;
  InelasticMarks inelastic;
  for (std::size_t first = begin; first < end; first += elastic_run) {
    const std::size_t last = std::min(end, first + elastic_run);
    inelastic.fill(1.0);
    if constexpr (runs && hookean) {
      if constexpr (dissipative)
        law_.mark_inelastic(p, first, last, duration, inelastic);
      else
        inelastic.fill(0.0);
    }
    for (std::size_t i = first; i < last; ++i) {
      load(p, i, s);
      const SymmetricTensor strain{p.strain_increment[0][i], p.strain_increment[1][i],
                                   p.strain_increment[2][i], p.strain_increment[3][i]};
      if constexpr (hookean) {
        if (inelastic[i - first] == 0.0) {
          s.elastic_strain += strain;
          tangents[i] = elastic_entries(law_.secant_moduli(s));
          continue;
        }
      }
      s.stress = law_.stress(s);
      tangents[i] = tangent_by_differences(s, strain, duration);
    }
  }
}

}  // namespace vitrum
