#pragma once
#include "materials/batch.hpp"
#include "materials/composite/elastic_limit.hpp"
#include "materials/composite/evolution.hpp"
#include "materials/composite/make.hpp"
#include "materials/composite/models.hpp"

namespace vitrum {

/// The composite in closed form.
///
/// An increment is a straight line in (corotational) strain. It is followed leg by leg: a leg ends where the
/// mean strain changes sign (damage acts on one side, Drucker-Prager on the other), at localisation, or with
/// the increment. Within a leg the state after any fraction is closed-form (`state_along`), so events are
/// located by bisection and a leg of any length does not overshoot.
template <bool has_damage, Yielding yielding, bool has_decohesion>
class CompositeClosedForm : public CompositeModels<has_damage, yielding, has_decohesion> {
  using Models = CompositeModels<has_damage, yielding, has_decohesion>;

 public:
  using State = CompositeState;
  using Models::has_yield;
  using Models::secant_moduli;
  using Models::stored_energy;
  using Models::stress;

  CompositeClosedForm(const MaterialParameters& parameters, double cell)
      : Models(parameters, cell), evolution_(parameters, cell) {}

  // The law (materials/batch.hpp).
  static constexpr bool dissipates = has_damage || Models::has_yield || has_decohesion;
  std::vector<Variable> variables() const;
  const Moduli& elastic() const { return elastic_; }
  double strain_scale() const { return elastic_limit(parameters_); }
  void start(const SymmetricTensor& given, CompositeState& s) const {
    s.elastic_strain = elastic_.strain(given);
  }
  void judge(CompositeState& s, PointReport& report) const;
  void advance(CompositeState& s, const SymmetricTensor& strain, double duration, PointReport& report) const;
  /// The crack density, and where it gives the moduli before localisation only, whether that has been.
  std::vector<std::size_t> stress_columns() const {
    std::vector<std::size_t> columns;
    if (has_damage) columns.push_back(Column::crack_density);
    if (has_damage && has_decohesion && decohesion_.parameters().undamaged)
      columns.push_back(Column::effective_length);
    return columns;
  }
  std::optional<std::size_t> damage_column() const {
    return has_damage ? std::optional<std::size_t>(Column::crack_density) : std::nullopt;
  }
  std::optional<std::size_t> leaving_column() const {
    return has_decohesion && decohesion_.parameters().separated == Separated::removed
               ? std::optional<std::size_t>(Column::decohesion)
               : std::nullopt;
  }
  double damage(double crack_density) const {
    return has_damage && crack_density > 0.0 ? damage_.damage(crack_density / crack_density_limit) : 0.0;
  }
  const EventDriven* event_driven() const { return &evolution_; }
  const std::optional<StrengthScatter>& scatter() const { return damage_.scatter(); }

  // Elastic runs: the moduli depend on the crack density; a point with a plane is never elastic.
  static constexpr int elastic_column = has_damage ? 0 : -1;
  static constexpr bool marks_directions = true;
  bool mark_inelastic(const ParticleColumns& p, std::size_t begin, std::size_t end, double duration,
                      InelasticMarks& marks) const;
  void mark_by_rate(const ParticleColumns& p, std::size_t begin, std::size_t end, double duration,
                    InelasticMarks& marks) const;
  VITRUM_INLINE SymmetricTensor elastic_stress(const SymmetricTensor& e, double crack_density) const {
    return secant_without_branches(trace(e), crack_density).stress(e);
  }
  VITRUM_INLINE double elastic_energy(const SymmetricTensor& e, double crack_density) const {
    return secant_without_branches(trace(e), crack_density).energy(e);
  }

 private:
  using Models::damage_;
  using Models::damage_at_once;
  using Models::damage_localisation;
  using Models::damaging_strain;
  using Models::decohesion_;
  using Models::drucker_prager_;
  using Models::elastic_;
  using Models::fall_to_admissible_stress;
  using Models::flow;
  using Models::flow_behind_crack;
  using Models::flow_localisation;
  using Models::free_faces;
  using Models::is_overloaded;
  using Models::is_rubble;
  using Models::largest_normal_strain;
  using Models::localised_mode;
  using Models::parameters_;
  using Models::secant;
  using Models::secant_without_branches;
  using Models::separate;
  using Models::share_of_shear;
  using Models::snap_back;
  using Models::start_decohesion;
  using Models::stays_compressed;
  using Models::surface_acts;
  using Models::traction;
  using Models::von_mises_;
  using Models::yield_function;

  /// Columns of the variables that elastic runs look at.
  struct Column {
    static constexpr std::size_t crack_density = 0, max_rate = 1, plastic_strain = has_damage ? 2 : 0,
                                 decohesion = plastic_strain + (has_yield ? 1 : 0),
                                 effective_length = decohesion + 5;
  };

  /// A straight piece of the strain path on one side of zero mean strain.
  struct Leg {
    CompositeState start;
    SymmetricTensor strain;  ///< whole increment of the leg
    bool tension = false;
    double coefficient = 0.0;  ///< C(R) of eq. 7 on this leg
  };
  struct Followed {
    CompositeState state;
    double plastic_dissipation = 0.0;
  };
  /// A fraction of a leg and the state there.
  struct Place {
    double fraction;
    CompositeState state;
  };

  // intact.hpp
  double advance_intact(CompositeState& s, const SymmetricTensor& strain, double duration,
                        PointReport& report) const;
  void release_excess_shear(CompositeState& s, double done, PointReport& report) const;
  Followed state_along(const Leg& leg, double fraction) const;
  double leg_end(const Leg& leg) const;
  void record_events(const Leg& leg, const CompositeState& end, double end_fraction, double done,
                     PointReport& report) const;
  double damage_dissipation(const Leg& leg, const CompositeState& end, double end_fraction) const;

  // localisation_search.hpp
  bool is_critical(const Leg& leg, const CompositeState& s) const;
  bool may_localise(const Leg& leg, const CompositeState& from, const CompositeState& to) const;
  std::array<double, 2> turning_points(const Leg& leg, double end) const;
  bool find_localisation(const Leg& leg, double& end, Followed& at_end) const;
  bool find_critical(const Leg& leg, const Place& from, const Place& to, int halvings, double& first) const;

  // localised.hpp, rubble.hpp
  void advance_localised(CompositeState& s, const SymmetricTensor& strain, double duration, double done,
                         PointReport& report) const;
  /// What a plane does at one instant when it loses its equilibrium.
  enum class Jump { none, snap_back, separation };
  double advance_cohesive(CompositeState& s, const SymmetricTensor& strain, double duration, bool at_once,
                          Jump& jump, Dissipation& dissipation) const;
  double outside_under_pressure(const CompositeState& s) const;
  void release_plane_at_once(CompositeState& s, Jump jump, bool flows, double fraction,
                             PointReport& report) const;
  double advance_separated(CompositeState& s, const SymmetricTensor& strain, Dissipation& dissipation) const;
  void rub_faces(CompositeState& s, const SymmetricTensor& strain, Dissipation& dissipation) const;
  void advance_rubble(CompositeState& s, const SymmetricTensor& strain, double done,
                      PointReport& report) const;
  void load_rubble(CompositeState& s, Dissipation& dissipation) const;
  double let_rubble_go(CompositeState& s, const SymmetricTensor& strain, Dissipation& dissipation) const;
  void flow_behind_crack(CompositeState& s, double outside_before, double fraction,
                         PointReport& report) const;

  CompositeEvolution<has_damage, yielding, has_decohesion> evolution_;
};

template <bool D, Yielding Y, bool C>
std::vector<Variable> CompositeClosedForm<D, Y, C>::variables() const {
  std::vector<Variable> list;
  [[maybe_unused]] const auto add = [&list](const std::vector<Variable>& model) {
    list.insert(list.end(), model.begin(), model.end());
  };
  if constexpr (D) add(damage_variables());
  if constexpr (has_yield) add(plasticity_variables());
  if constexpr (C) add(decohesion_variables());
  if constexpr (D) {
    if (damage_.averages_rate()) add(averaged_rate_variables());
    if (damage_.scatter()) add(scatter_variables());
  }
  return list;
}

template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::advance(CompositeState& s, const SymmetricTensor& strain,
                                           [[maybe_unused]] double duration,
                                           [[maybe_unused]] PointReport& report) const {
  if constexpr (!dissipates) {
    s.elastic_strain += strain;
  } else {
    double done = 0.0;
    if (!C || !is_localised(s)) done = advance_intact(s, strain, duration, report);
    if constexpr (C)
      if (is_localised(s) && done < 1.0)
        advance_localised(s, (1.0 - done) * strain, (1.0 - done) * duration, done, report);
  }
}

}  // namespace vitrum
