#pragma once
#include <algorithm>
#include <limits>

#include "materials/material.hpp"
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
class Composite final : public Material {
 public:
  Composite(const MaterialParameters& parameters, double cell);

  const MaterialParameters& parameters() const override { return parameters_; }
  std::span<const VariableInfo> variables() const override { return variables_; }
  double wave_speed() const override { return std::sqrt(elastic_.p_wave() / parameters_.elastic.density); }
  PointState initial_state(const SymmetricTensor& stress) const override;
  void judge(PointState& state, PointReport& report) const override;
  void respond(PointState& state, const SymmetricTensor& strain_increment, double duration,
               PointReport& report) const override;
  void respond(const ParticleColumns& particles, std::size_t begin, std::size_t end, double duration,
               PointIntegrator* integrator, BatchReport& report) const override;
  EvolutionMode enter(PointState& state, const StrainPath& path, PointReport& report) const override;
  void leave(EvolutionMode& mode, Root root, PointState& state, const StrainPath& path, double fraction,
             PointReport& report) const override;
  EvolutionRates rates(const EvolutionMode& mode, const PointState& state,
                       const StrainPath& path) const override;
  OpeningJacobian opening_jacobian(const EvolutionMode& mode, const PointState& state,
                                   const StrainPath& path) const override;
  void events(const EvolutionMode& mode, const PointState& state, const StrainPath& path,
              EventFunctions& functions) const override;
  void settle(const EvolutionMode& mode, PointState& state, const StrainPath& path) const override;
  TangentEntries tangent(const PointState& state, const SymmetricTensor& strain_increment,
                         double duration) const override;
  void tangent(const ParticleColumns& particles, std::size_t begin, std::size_t end, double duration,
               TangentEntries* tangents) const override;
  Moduli secant_moduli(const PointState& s) const override {
    return secant(trace(s.elastic_strain) > 0.0, s.crack_density);
  }
  double damage(const PointState& s) const override;
  void stress(const std::array<const double*, 4>& elastic_strain, const double* crack_density,
              std::size_t size, const std::array<double*, 4>& stress) const override;

 private:
  static constexpr bool has_yield = yielding != Yielding::none;
  static constexpr std::size_t elastic_run = 64;  ///< most particles of one vectorised loop
  static constexpr bool elastic_only = !has_damage && !has_yield && !has_decohesion;

  /// A straight piece of the strain path on one side of zero mean strain.
  struct Leg {
    PointState start;
    SymmetricTensor strain;  ///< whole increment of the leg
    bool tension = false;
    double coefficient = 0.0;  ///< C(R) of eq. 7 on this leg
  };
  struct Followed {
    PointState state;
    double plastic_dissipation = 0.0;
  };
  /// A fraction of a leg and the state there.
  struct Place {
    double fraction;
    PointState state;
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

  /// Calls f(Variable) for the internal variables of the models present, in the order of Variable.
  template <class F>
  static void for_own_variables([[maybe_unused]] F&& f) {
    using V = Variable;
    if constexpr (has_damage) f(V::crack_density), f(V::max_rate);
    if constexpr (has_yield) f(V::plastic_strain);
    if constexpr (has_decohesion) {
      f(V::decohesion), f(V::opening_n), f(V::opening_t), f(V::normal_r), f(V::normal_z);
      f(V::effective_length), f(V::cohesive_strength);
    }
    if constexpr (!elastic_only) f(V::dissipated);
  }

  // composite_batch.hpp
  using Marks = std::array<double, elastic_run>;
  bool stays_elastic(const PointState& s, const SymmetricTensor& strain, double duration) const;
  bool mark_inelastic(const ParticleColumns& p, std::size_t begin, std::size_t end, double duration,
                      Marks& marks) const;
  void load(const ParticleColumns& p, std::size_t i, PointState& s) const;
  void store_variables(const PointState& s, const ParticleColumns& p, std::size_t i) const;
  template <bool small>
  double take_elastic_turning(const ParticleColumns& p, std::size_t begin, std::size_t end) const;
  void store_elastic_stress(const ParticleColumns& p, std::size_t begin, std::size_t end) const;
  double take_elastic(const ParticleColumns& p, std::size_t begin, std::size_t end) const;
  double take_inelastic(const ParticleColumns& p, std::size_t i, PointState& s, double duration,
                        PointIntegrator* integrator, PointReport& point, BatchReport& report) const;

  // composite_intact.hpp
  double advance_intact(PointState& s, const SymmetricTensor& strain, double duration,
                        PointReport& report) const;
  void release_excess_shear(PointState& s, double done, PointReport& report) const;
  Followed follow(const Leg& leg, double fraction) const;
  double leg_end(const Leg& leg) const;
  double flow(PointState& s, const Moduli& moduli, double violated_before) const;
  double yield_function(const PointState& s, const Moduli& moduli) const;
  bool is_critical(const Leg& leg, const PointState& s) const;
  bool may_localise(const Leg& leg, const PointState& from, const PointState& to) const;
  std::array<double, 2> turning_points(const Leg& leg, double end) const;
  bool find_localisation(const Leg& leg, double& end, Followed& at_end) const;
  bool find_critical(const Leg& leg, const Place& from, const Place& to, int halvings, double& first) const;
  void start_decohesion(bool tension, bool damage_grows, PointState& s) const;
  void record_events(const Leg& leg, const PointState& end, double end_fraction, double done,
                     PointReport& report) const;
  double damage_dissipation(const Leg& leg, const PointState& end, double end_fraction) const;

  // composite_start.hpp
  void damage_at_once(PointState& s, PointReport& report) const;

  // composite_localised.hpp
  void advance_localised(PointState& s, const SymmetricTensor& strain, double duration, double done,
                         PointReport& report) const;
  /// What a plane does at one instant when it loses its equilibrium.
  enum class Jump { none, snap_back, separation };
  double advance_cohesive(PointState& s, const SymmetricTensor& strain, double duration, bool at_once,
                          Jump& jump, Dissipation& dissipation) const;
  EvolutionMode localised_mode(const PointState& s) const;
  double outside_under_pressure(const PointState& s) const;
  void give_way_at_once(PointState& s, Jump jump, bool flows, double fraction, PointReport& report) const;
  double advance_separated(PointState& s, const SymmetricTensor& strain) const;
  void snap_back(PointState& s, const Moduli& moduli, Dissipation& dissipation) const;
  void open_plane(PointState& s, const DecohesionLaw::Advance& next) const;
  void separate(PointState& s, const Moduli& moduli, Dissipation& dissipation) const;
  void relax_crack(PointState& s) const;
  void flow_behind_crack(PointState& s, double outside_before, double fraction, PointReport& report) const;
  void flow_behind_crack(PointState& s, double outside_before, Dissipation& dissipation) const;
  bool fell_behind_crack(const PointState& s, double flowed_before) const;
  SymmetricTensor flow_along_deviator(PointState& s, double excess) const;
  PlaneTraction traction(const DecohesionPlane& plane, const SymmetricTensor& strain,
                         const Moduli& moduli) const {
    const SymmetricTensor stress = moduli.stress(strain);
    return {plane.normal_part(stress), plane.tangential_part(stress), moduli.p_wave(), moduli.shear};
  }

  // composite_rates.hpp
  /// A softening plane: what drives it, and per unit of lambda: strain of the jump, stiffness and fall of
  /// strength (Pa).
  struct Softening {
    PlaneDrive drive{};
    SymmetricTensor jump{};
    double stiffness = 0.0, slope = 0.0, strength = 0.0;
  };
  static constexpr bool surface_acts(bool tension);
  SymmetricTensor yield_gradient(const PointState& s, const Moduli& moduli) const;
  SymmetricTensor flow_direction(const PointState& s) const;
  SymmetricTensor give_way(const EvolutionMode& mode, const PointState& s, const Moduli& moduli,
                           const SymmetricTensor& strain, double& gap, double& slip) const;
  Softening softening(const EvolutionMode& mode, const PointState& s, const Moduli& moduli) const;
  double flow_localisation(const PointState& s, const Moduli& moduli, double modulus) const;
  double largest_normal_strain(const SymmetricTensor& strain) const;
  double damage_localisation(const PointState& s) const;
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

  // composite_modes.hpp, composite_settle.hpp
  void choose(EvolutionMode& mode, std::optional<Root> root, PointState& s, const StrainPath& path,
              double fraction, PointReport& report) const;
  void choose_damage(EvolutionMode& mode, PointState& s, const StrainPath& path, double fraction,
                     PointReport& report) const;
  bool strength_is_spent(const PointState& s, const StrainPath& path) const;
  bool jump(EvolutionMode& mode, PointState& s, const StrainPath& path, double fraction, bool runs_away,
            PointReport& report) const;
  bool is_near_surface(const EvolutionMode& mode, const PointState& s) const;
  void step_inside(const EvolutionMode& mode, PointState& s) const;
  bool on_surface(const EvolutionMode& mode, const PointState& s, bool reached) const;
  bool at_strength(const EvolutionMode& mode, const PointState& s) const;
  void set_branch(EvolutionMode& mode, const PointState& s) const;
  bool choose_flow(EvolutionMode& mode, const PointState& s, const StrainPath& path, bool may_flow,
                   bool may_open) const;

  // composite_jumps.hpp
  bool fall_onto_surface(const EvolutionMode& mode, PointState& s, Dissipation& dissipation) const;
  bool is_overloaded(const EvolutionMode& mode, const PointState& s) const;
  void meet_surfaces(EvolutionMode& mode, PointState& s, double fraction, PointReport& report,
                     bool is_yield = true) const;
  void land(EvolutionMode& mode, PointState& s, double fraction, PointReport& report) const;
  bool falls_through(const EvolutionMode& mode, const PointState& s) const;
  void fall_at_constant_strain(EvolutionMode& mode, PointState& s, double fraction,
                               PointReport& report) const;
  bool snaps_back_alone(EvolutionMode mode, const PointState& s, const StrainPath& path) const;
  bool flow_with_plane(PointState& s, const Moduli& m, double amount) const;
  void fall_with_plane(EvolutionMode& mode, PointState& s, double fraction, PointReport& report) const;
  bool localises(const EvolutionMode& mode, const PointState& s) const;
  void localise(EvolutionMode& mode, PointState& s, double fraction, PointReport& report) const;
  void release_plane(EvolutionMode& mode, PointState& s, double fraction, PointReport& report) const;
  void separate_plane(EvolutionMode& mode, PointState& s, double fraction, PointReport& report) const;
  void enter_separated(EvolutionMode& mode, const PointState& s, double fraction, PointReport& report) const;
  bool shear_carries_strength(const EvolutionMode& mode, const PointState& s) const;

  MaterialParameters parameters_;
  std::vector<VariableInfo> variables_;
  Moduli elastic_;
  double cell_;
  DamageLaw damage_;
  VonMisesLaw von_mises_;
  DruckerPragerLaw drucker_prager_;
  DecohesionLaw decohesion_;
};

}  // namespace vitrum
