#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/composite/mode.hpp"
#include "materials/material_parameters.hpp"
#include "materials/root.hpp"

namespace vitrum {

enum class Yielding { none, von_mises, drucker_prager };

/// The models of one material put together: moduli of damage, a yield surface, a plane of decohesion, and
/// what they do to a state at one instant. What the template arguments leave out is neither computed nor
/// loaded nor stored. Over it stand two forms of one law, each the other's oracle: increments in closed form
/// (closed_form.hpp), and an ODE with modes (evolution.hpp).
template <bool has_damage, Yielding yielding, bool has_decohesion>
class CompositeModels {
 public:
  static constexpr bool has_yield = yielding != Yielding::none;

  CompositeModels(const MaterialParameters& parameters, double cell)
      : parameters_(parameters), elastic_(elastic_moduli(parameters.elastic)), cell_(cell) {
    if constexpr (has_damage) damage_ = DamageLaw(*parameters.damage, parameters.elastic);
    if constexpr (yielding == Yielding::von_mises) von_mises_ = VonMisesLaw(*parameters.von_mises);
    if constexpr (yielding == Yielding::drucker_prager) {
      drucker_prager_ = DruckerPragerLaw(*parameters.drucker_prager);
      rubble_ =
          DruckerPragerLaw({.yield = 0.0, .beta = parameters.drucker_prager->beta, .associated = false});
    }
    if constexpr (has_decohesion) decohesion_ = DecohesionLaw(*parameters.decohesion);
  }

  /// Calls f(variable) for what is stored of a state.
  template <class S, class F>
  VITRUM_INLINE void members([[maybe_unused]] S& s, [[maybe_unused]] F&& f) const {
    if constexpr (has_damage) f(s.crack_density), f(s.max_rate);
    if constexpr (has_yield) f(s.plastic_strain);
    if constexpr (has_decohesion) {
      f(s.decohesion), f(s.opening_n), f(s.opening_t), f(s.normal);
      f(s.effective_length), f(s.cohesive_strength);
    }
    if constexpr (has_damage) {
      if (damage_.averages_rate()) f(s.mean_rate);
      if (damage_.scatter()) f(s.strength_factor);
    }
  }
  /// Moduli that give the stress of a state (damaged bulk modulus only under tension).
  Moduli secant_moduli(const CompositeState& s) const { return secant(trace(s.elastic_strain) > 0.0, s); }
  double stored_energy(const CompositeState& s) const { return secant_moduli(s).energy(s.elastic_strain); }
  SymmetricTensor stress(const CompositeState& s) const { return secant_moduli(s).stress(s.elastic_strain); }

 protected:
  Moduli secant(bool tension, const CompositeState& s) const {
    if constexpr (has_damage) {
      if (s.crack_density <= 0.0 || (is_localised(s) && decohesion_.parameters().undamaged)) return elastic_;
      Moduli m = damage_.moduli(s.crack_density / crack_density_limit);
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

  /// eps_v as it enters eq. 7. A point that is f times as strong damages at f times the strain: its k is that
  /// of the law over f^m.
  double damaging_strain(const CompositeState& s) const {
    return damage_.strain_of(trace(s.elastic_strain)) / s.strength_factor;
  }

  // damage_at_once.hpp
  bool damage_at_once(CompositeState& s, double fraction, PointReport& report) const;

  /// Whether the point is rubble that bears shear under pressure.
  bool is_rubble(const CompositeState& s) const {
    if constexpr (has_decohesion && yielding == Yielding::drucker_prager)
      return is_separated(s) && decohesion_.parameters().separated == Separated::drucker_prager;
    else
      return false;
  }
  /// Eq. 19 of a point: rubble has no cohesion, and does not dilate.
  const DruckerPragerLaw& pressure_surface(const CompositeState& s) const {
    return is_rubble(s) ? rubble_ : drucker_prager_;
  }

  // yield_surface.hpp
  bool surface_acts(bool tension, const CompositeState& s) const;
  double yield_function(const CompositeState& s, const Moduli& moduli) const;
  SymmetricTensor yield_gradient(const CompositeState& s, const Moduli& moduli) const;
  SymmetricTensor flow_direction(const CompositeState& s) const;
  double yield_scale() const {
    if constexpr (yielding == Yielding::von_mises) return von_mises_.radius(0.0);
    if constexpr (yielding == Yielding::drucker_prager)
      return std::max(parameters_.drucker_prager->yield, tolerance::on_surface * elastic_.shear);
    return elastic_.shear;
  }

  double flow(CompositeState& s, const Moduli& moduli, double violated_before) const;
  bool fall_onto_surface(const CompositeMode& mode, CompositeState& s, Dissipation& dissipation) const;
  void fall_to_admissible_stress(CompositeMode& mode, CompositeState& s, double fraction, PointReport& report,
                                 bool is_yield = true) const;
  bool softens_past_equilibrium(const CompositeMode& mode, const CompositeState& s) const;

  // plane.hpp
  double largest_normal_strain(const SymmetricTensor& strain) const;
  double damage_localisation(const CompositeState& s) const;
  double flow_localisation(const CompositeState& s, const Moduli& moduli, double modulus) const;
  static double least_principal_strain(const SymmetricTensor& strain);
  double compression(const CompositeState& s) const;
  bool stays_compressed(const CompositeState& from, const CompositeState& to) const;
  void start_decohesion(bool tension, bool damage_grows, CompositeState& s, Dissipation& dissipation) const;
  CompositeMode localised_mode(const CompositeState& s) const;
  PlaneTraction traction(const DecohesionPlane& plane, const SymmetricTensor& strain,
                         const Moduli& moduli) const {
    const SymmetricTensor stress = moduli.stress(strain);
    return {plane.normal_part(stress), plane.tangential_part(stress), moduli.p_wave(), moduli.shear};
  }
  SymmetricTensor strain_left_by_faces(const CompositeMode& mode, const CompositeState& s,
                                       const Moduli& moduli, const SymmetricTensor& strain, double& gap,
                                       double& slip) const;
  double face_slip(const CompositeMode& mode, const PlaneTraction& change, double length) const;
  bool is_overloaded(const CompositeMode& mode, const CompositeState& s) const;
  void open_plane(CompositeState& s, const DecohesionLaw::Advance& next) const;
  void snap_back(CompositeState& s, const Moduli& moduli, Dissipation& dissipation) const;
  void free_faces(CompositeState& s) const;
  double share_of_shear(const CompositeState& s, const SymmetricTensor& strain) const;
  void separate(CompositeState& s, const Moduli& moduli, Dissipation& dissipation) const;
  void enter_separated(CompositeMode& mode, const CompositeState& s, double fraction,
                       PointReport& report) const;

  // flow_behind_crack.hpp
  void flow_behind_crack(CompositeState& s, bool tension, double outside_before,
                         Dissipation& dissipation) const;
  bool fell_behind_crack(const CompositeState& s, double flowed_before) const;
  SymmetricTensor flow_along_deviator(CompositeState& s, double excess) const;

  MaterialParameters parameters_;
  Moduli elastic_;
  double cell_;
  DamageLaw damage_;
  VonMisesLaw von_mises_;
  DruckerPragerLaw drucker_prager_, rubble_;
  DecohesionLaw decohesion_;
};

}  // namespace vitrum
