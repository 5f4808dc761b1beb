#pragma once
#include <algorithm>
#include <limits>

#include "materials/composite/elastic_limit.hpp"
#include "materials/composite/evolution.hpp"
#include "materials/composite/make.hpp"
#include "materials/root.hpp"

namespace vitrum {

enum class Yielding { none, von_mises, drucker_prager };

/// The models of one material put together. What the template arguments leave out is neither computed nor
/// loaded nor stored.
///
/// An increment is a straight line in (corotational) strain. It is followed leg by leg: a leg ends where the
/// mean strain changes sign (damage acts on one side, Drucker-Prager on the other), at localisation, or with
/// the increment. Within a leg the state after any fraction is closed-form (`follow`), so events are located
/// by bisection and a leg of any length does not overshoot.
template <bool has_damage, Yielding yielding, bool has_decohesion>
class Composite final : public CompositeModes {
 public:
  using State = CompositeState;

  Composite(const MaterialParameters& parameters, double cell);

  // The law (materials/batch.hpp).
  static constexpr bool has_yield = yielding != Yielding::none;
  static constexpr bool dissipates = has_damage || has_yield || has_decohesion;
  std::vector<Variable> variables() const;
  template <class S, class F>
  void members([[maybe_unused]] S& s, [[maybe_unused]] F&& f) const {
    if constexpr (has_damage) f(s.crack_density), f(s.max_rate);
    if constexpr (has_yield) f(s.plastic_strain);
    if constexpr (has_decohesion) {
      f(s.decohesion), f(s.opening_n), f(s.opening_t), f(s.normal);
      f(s.effective_length), f(s.cohesive_strength);
    }
  }
  const Moduli& elastic() const { return elastic_; }
  double strain_scale() const { return elastic_limit(parameters_); }
  void start(const SymmetricTensor& stress, CompositeState& s) const {
    s.elastic_strain = elastic_.strain(stress);
  }
  void judge(CompositeState& s, PointReport& report) const;
  void advance(CompositeState& s, const SymmetricTensor& strain, double duration, PointReport& report) const;
  SymmetricTensor stress(const CompositeState& s) const { return secant_moduli(s).stress(s.elastic_strain); }
  double stored_energy(const CompositeState& s) const { return secant_moduli(s).energy(s.elastic_strain); }
  Moduli secant_moduli(const CompositeState& s) const override {
    return secant(trace(s.elastic_strain) > 0.0, s.crack_density);
  }
  std::optional<std::size_t> damage_column() const {
    return has_damage ? std::optional<std::size_t>(Column::crack_density) : std::nullopt;
  }
  double damage(double crack_density) const {
    return has_damage && crack_density > 0.0 ? damage_.damage(crack_density / crack_density_limit) : 0.0;
  }
  const EventDriven* event_driven() const { return this; }

  // Elastic runs: the moduli depend on the crack density; a point with a plane is never elastic.
  static constexpr int elastic_column = has_damage ? 0 : -1;
  static constexpr bool marks_directions = true;
  bool mark_inelastic(const ParticleColumns& p, std::size_t begin, std::size_t end, double duration,
                      InelasticMarks& marks) const;
  VITRUM_INLINE SymmetricTensor elastic_stress(const SymmetricTensor& e, double crack_density) const {
    return secant_without_branches(trace(e), crack_density).stress(e);
  }
  VITRUM_INLINE double elastic_energy(const SymmetricTensor& e, double crack_density) const {
    return secant_without_branches(trace(e), crack_density).energy(e);
  }

  // The same law as an ODE.
  CompositeState load(const PointState& point) const override { return load_state(*this, point); }
  void store(const CompositeState& s, PointState& point) const override { store_state(*this, s, point); }
  EvolutionMode first_mode(CompositeState& state, const StrainPath& path, PointReport& report) const override;
  void leave(EvolutionMode& mode, Root root, CompositeState& state, const StrainPath& path, double fraction,
             PointReport& report) const override;
  EvolutionRates rates(const EvolutionMode& mode, const CompositeState& state,
                       const StrainPath& path) const override;
  OpeningJacobian opening_jacobian(const EvolutionMode& mode, const CompositeState& state,
                                   const StrainPath& path) const override;
  void guards(const EvolutionMode& mode, const CompositeState& state, const StrainPath& path,
              Guards& values) const override;
  void settle(const EvolutionMode& mode, CompositeState& state, const StrainPath& path) const override;
  Moduli virgin_moduli() const override { return elastic_; }
  double reference_opening() const override { return has_decohesion ? decohesion_.reference_opening() : 0.0; }

 private:
  /// Columns of the variables that elastic runs look at.
  struct Column {
    static constexpr std::size_t crack_density = 0, max_rate = 1, plastic_strain = has_damage ? 2 : 0,
                                 effective_length = plastic_strain + (has_yield ? 1 : 0) + 5;
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

  Moduli secant(bool tension, double crack_density) const {
    if constexpr (has_damage) {
      if (crack_density <= 0.0) return elastic_;
      Moduli m = damage_.moduli(crack_density / crack_density_limit);
      if (!tension) m.bulk = elastic_.bulk;  // closed cracks carry pressure
      return m;
    } else {
      return elastic_;
    }
  }

  /// The same, for loops that are vectorised.
  VITRUM_INLINE Moduli secant_without_branches([[maybe_unused]] double strain_trace,
                                               [[maybe_unused]] double crack_density) const {
    Moduli m = elastic_;
    if constexpr (has_damage) {
      const Moduli damaged = damage_.moduli(crack_density / crack_density_limit);
      const bool is_damaged = !(crack_density <= 0.0);  // what is not a number shows
      m.shear = is_damaged ? damaged.shear : m.shear;
      m.bulk = is_damaged && strain_trace > 0.0 ? damaged.bulk : m.bulk;
    }
    return m;
  }

  // intact.hpp
  double advance_intact(CompositeState& s, const SymmetricTensor& strain, double duration,
                        PointReport& report) const;
  void release_excess_shear(CompositeState& s, double done, PointReport& report) const;
  Followed follow(const Leg& leg, double fraction) const;
  double leg_end(const Leg& leg) const;
  double flow(CompositeState& s, const Moduli& moduli, double violated_before) const;
  double yield_function(const CompositeState& s, const Moduli& moduli) const;
  bool is_critical(const Leg& leg, const CompositeState& s) const;
  bool may_localise(const Leg& leg, const CompositeState& from, const CompositeState& to) const;
  std::array<double, 2> turning_points(const Leg& leg, double end) const;
  bool find_localisation(const Leg& leg, double& end, Followed& at_end) const;
  bool find_critical(const Leg& leg, const Place& from, const Place& to, int halvings, double& first) const;
  void start_decohesion(bool tension, bool damage_grows, CompositeState& s) const;
  void record_events(const Leg& leg, const CompositeState& end, double end_fraction, double done,
                     PointReport& report) const;
  double damage_dissipation(const Leg& leg, const CompositeState& end, double end_fraction) const;

  // start.hpp
  void damage_at_once(CompositeState& s, PointReport& report) const;

  // localised.hpp
  void advance_localised(CompositeState& s, const SymmetricTensor& strain, double duration, double done,
                         PointReport& report) const;
  /// What a plane does at one instant when it loses its equilibrium.
  enum class Jump { none, snap_back, separation };
  double advance_cohesive(CompositeState& s, const SymmetricTensor& strain, double duration, bool at_once,
                          Jump& jump, Dissipation& dissipation) const;
  EvolutionMode localised_mode(const CompositeState& s) const;
  double outside_under_pressure(const CompositeState& s) const;
  void give_way_at_once(CompositeState& s, Jump jump, bool flows, double fraction, PointReport& report) const;
  double advance_separated(CompositeState& s, const SymmetricTensor& strain) const;
  void snap_back(CompositeState& s, const Moduli& moduli, Dissipation& dissipation) const;
  void open_plane(CompositeState& s, const DecohesionLaw::Advance& next) const;
  void separate(CompositeState& s, const Moduli& moduli, Dissipation& dissipation) const;
  void relax_crack(CompositeState& s) const;
  void flow_behind_crack(CompositeState& s, double outside_before, double fraction,
                         PointReport& report) const;
  void flow_behind_crack(CompositeState& s, double outside_before, Dissipation& dissipation) const;
  bool fell_behind_crack(const CompositeState& s, double flowed_before) const;
  SymmetricTensor flow_along_deviator(CompositeState& s, double excess) const;
  PlaneTraction traction(const DecohesionPlane& plane, const SymmetricTensor& strain,
                         const Moduli& moduli) const {
    const SymmetricTensor stress = moduli.stress(strain);
    return {plane.normal_part(stress), plane.tangential_part(stress), moduli.p_wave(), moduli.shear};
  }

  // rates.hpp
  /// A softening plane: what drives it, and per unit of lambda: strain of the jump, stiffness and fall of
  /// strength (Pa).
  struct Softening {
    PlaneDrive drive{};
    SymmetricTensor jump{};
    double stiffness = 0.0, slope = 0.0, strength = 0.0;
  };
  static constexpr bool surface_acts(bool tension);
  SymmetricTensor yield_gradient(const CompositeState& s, const Moduli& moduli) const;
  SymmetricTensor flow_direction(const CompositeState& s) const;
  SymmetricTensor give_way(const EvolutionMode& mode, const CompositeState& s, const Moduli& moduli,
                           const SymmetricTensor& strain, double& gap, double& slip) const;
  Softening softening(const EvolutionMode& mode, const CompositeState& s, const Moduli& moduli) const;
  double flow_localisation(const CompositeState& s, const Moduli& moduli, double modulus) const;
  double largest_normal_strain(const SymmetricTensor& strain) const;
  double damage_localisation(const CompositeState& s) const;
  /// Change of the effective traction that a strain brings, Pa.
  static double pull(const DecohesionPlane& plane, const PlaneDrive& drive, const Moduli& moduli,
                     const SymmetricTensor& strain) {
    const SymmetricTensor stress = moduli.stress(strain);
    return drive.normal * plane.normal_part(stress) + drive.tangential * plane.tangential_part(stress);
  }
  double yield_scale() const {
    if constexpr (yielding == Yielding::von_mises) return von_mises_.radius(0.0);
    if constexpr (yielding == Yielding::drucker_prager)
      return std::max(parameters_.drucker_prager->yield, 1e-9 * elastic_.shear);
    return elastic_.shear;
  }

  // modes.hpp, composite_settle.hpp
  void choose(EvolutionMode& mode, std::optional<Root> root, CompositeState& s, const StrainPath& path,
              double fraction, PointReport& report) const;
  void choose_damage(EvolutionMode& mode, CompositeState& s, const StrainPath& path, double fraction,
                     PointReport& report) const;
  bool strength_is_spent(const CompositeState& s, const StrainPath& path) const;
  bool jump(EvolutionMode& mode, CompositeState& s, const StrainPath& path, double fraction, bool runs_away,
            PointReport& report) const;
  bool is_near_surface(const EvolutionMode& mode, const CompositeState& s) const;
  void step_inside(const EvolutionMode& mode, CompositeState& s) const;
  bool on_surface(const EvolutionMode& mode, const CompositeState& s, bool reached) const;
  bool at_strength(const EvolutionMode& mode, const CompositeState& s) const;
  void set_branch(EvolutionMode& mode, const CompositeState& s) const;
  bool choose_flow(EvolutionMode& mode, const CompositeState& s, const StrainPath& path, bool may_flow,
                   bool may_open) const;

  // jumps.hpp
  bool fall_onto_surface(const EvolutionMode& mode, CompositeState& s, Dissipation& dissipation) const;
  bool is_overloaded(const EvolutionMode& mode, const CompositeState& s) const;
  void meet_surfaces(EvolutionMode& mode, CompositeState& s, double fraction, PointReport& report,
                     bool is_yield = true) const;
  void land(EvolutionMode& mode, CompositeState& s, double fraction, PointReport& report) const;
  bool falls_through(const EvolutionMode& mode, const CompositeState& s) const;
  void fall_at_constant_strain(EvolutionMode& mode, CompositeState& s, double fraction,
                               PointReport& report) const;
  bool snaps_back_alone(EvolutionMode mode, const CompositeState& s, const StrainPath& path) const;
  bool flow_with_plane(CompositeState& s, const Moduli& m, double amount) const;
  void fall_with_plane(EvolutionMode& mode, CompositeState& s, double fraction, PointReport& report) const;
  bool localises(const EvolutionMode& mode, const CompositeState& s) const;
  void localise(EvolutionMode& mode, CompositeState& s, double fraction, PointReport& report) const;
  void release_plane(EvolutionMode& mode, CompositeState& s, double fraction, PointReport& report) const;
  void separate_plane(EvolutionMode& mode, CompositeState& s, double fraction, PointReport& report) const;
  void enter_separated(EvolutionMode& mode, const CompositeState& s, double fraction,
                       PointReport& report) const;
  bool shear_carries_strength(const EvolutionMode& mode, const CompositeState& s) const;

  MaterialParameters parameters_;
  Moduli elastic_;
  double cell_;
  DamageLaw damage_;
  VonMisesLaw von_mises_;
  DruckerPragerLaw drucker_prager_;
  DecohesionLaw decohesion_;
};

}  // namespace vitrum
