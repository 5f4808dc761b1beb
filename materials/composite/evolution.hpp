#pragma once
#include "materials/composite/models.hpp"

namespace vitrum {

/// The composite as an ODE: rates within a mode, guards that end it, transitions to the next.
template <bool has_damage, Yielding yielding, bool has_decohesion>
class CompositeEvolution final : public CompositeModes,
                                 private CompositeModels<has_damage, yielding, has_decohesion> {
  using Models = CompositeModels<has_damage, yielding, has_decohesion>;

 public:
  using State = CompositeState;
  using Models::has_yield;
  using Models::members;

  using Models::Models;

  CompositeState load(const PointState& point) const override { return load_state(*this, point); }
  void store(const CompositeState& s, PointState& point) const override { store_state(*this, s, point); }
  CompositeMode first_mode(CompositeState& state, const StrainPath& path, PointReport& report) const override;
  void transition(CompositeMode& mode, CompositeGuard root, CompositeState& state, const StrainPath& path,
                  double fraction, PointReport& report) const override;
  CompositeRates rates(const CompositeMode& mode, const CompositeState& state,
                       const StrainPath& path) const override;
  OpeningJacobian opening_jacobian(const CompositeMode& mode, const CompositeState& state,
                                   const StrainPath& path) const override;
  void guards(const CompositeMode& mode, const CompositeState& state, const StrainPath& path,
              Guards& values) const override;
  void project(const CompositeMode& mode, CompositeState& state, const StrainPath& path) const override;
  Moduli secant_moduli(const CompositeState& s) const override { return Models::secant_moduli(s); }
  Moduli virgin_moduli() const override { return elastic_; }
  double reference_opening(const CompositeState& s) const override {
    return has_decohesion ? decohesion_.opening(s.cohesive_strength) : 0.0;
  }

 private:
  using Models::damage_;
  using Models::damage_at_once;
  using Models::damage_localisation;
  using Models::damaging_strain;
  using Models::decohesion_;
  using Models::elastic_;
  using Models::enter_separated;
  using Models::face_slip;
  using Models::fall_to_admissible_stress;
  using Models::flow;
  using Models::flow_behind_crack;
  using Models::flow_direction;
  using Models::flow_localisation;
  using Models::free_faces;
  using Models::is_rubble;
  using Models::open_plane;
  using Models::secant;
  using Models::separate;
  using Models::share_of_shear;
  using Models::snap_back;
  using Models::softens_past_equilibrium;
  using Models::start_decohesion;
  using Models::stored_energy;
  using Models::strain_left_by_faces;
  using Models::stress;
  using Models::surface_acts;
  using Models::traction;
  using Models::von_mises_;
  using Models::yield_function;
  using Models::yield_gradient;
  using Models::yield_scale;

  // rates.hpp
  /// A softening plane: what drives it, and per unit of lambda: strain of the jump, stiffness and fall of
  /// strength (Pa).
  struct Softening {
    PlaneDrive drive{};
    SymmetricTensor jump{};
    double stiffness = 0.0, slope = 0.0, strength = 0.0;
  };
  Softening softening(const CompositeMode& mode, const CompositeState& s, const Moduli& moduli) const;
  /// Change of the effective traction that a strain brings, Pa.
  static double traction_change(const DecohesionPlane& plane, const PlaneDrive& drive, const Moduli& moduli,
                                const SymmetricTensor& strain) {
    const SymmetricTensor stress = moduli.stress(strain);
    return drive.normal * plane.normal_part(stress) + drive.tangential * plane.tangential_part(stress);
  }

  // transitions.hpp, projection.hpp
  void select_models(CompositeMode& mode, std::optional<CompositeGuard> root, CompositeState& s,
                     const StrainPath& path, double fraction, PointReport& report) const;
  void select_damage(CompositeMode& mode, CompositeState& s, const StrainPath& path, double fraction,
                     PointReport& report) const;
  bool strength_is_spent(const CompositeState& s, const StrainPath& path) const;
  bool perform_jump(CompositeMode& mode, CompositeState& s, const StrainPath& path, double fraction,
                    bool runs_away, PointReport& report) const;
  bool is_near_surface(const CompositeMode& mode, const CompositeState& s) const;
  void step_inside_surface(const CompositeMode& mode, CompositeState& s) const;
  bool on_surface(const CompositeMode& mode, const CompositeState& s, bool reached) const;
  bool at_strength(const CompositeMode& mode, const CompositeState& s) const;
  void set_branch(CompositeMode& mode, const CompositeState& s) const;
  void select_proportional(CompositeMode& mode, const CompositeState& s, const StrainPath& path,
                           double fraction, PointReport& report) const;
  bool faces_part(CompositeMode mode, const CompositeState& s, const StrainPath& path, bool may_flow) const;
  bool select_flow_and_sliding(CompositeMode& mode, const CompositeState& s, const StrainPath& path,
                               bool may_flow, bool may_slide) const;
  void project_faces(const CompositeMode& mode, CompositeState& s) const;
  bool select_flow_and_opening(CompositeMode& mode, const CompositeState& s, const StrainPath& path,
                               bool may_flow, bool may_open, bool may_slide) const;

  // jumps.hpp
  void resume_after_jump(CompositeMode& mode, CompositeState& s, double fraction, PointReport& report) const;
  void fall_at_constant_strain(CompositeMode& mode, CompositeState& s, double fraction,
                               PointReport& report) const;
  bool snaps_back_alone(CompositeMode mode, const CompositeState& s, const StrainPath& path) const;
  bool flow_with_plane(CompositeState& s, const Moduli& m, double amount) const;
  void fall_with_plane(CompositeMode& mode, CompositeState& s, double fraction, PointReport& report) const;
  bool localises(const CompositeMode& mode, const CompositeState& s) const;
  void localise(CompositeMode& mode, CompositeState& s, double fraction, PointReport& report) const;
  void release_plane(CompositeMode& mode, CompositeState& s, double fraction, PointReport& report) const;
  void separate_plane(CompositeMode& mode, CompositeState& s, double fraction, PointReport& report) const;
  bool shear_carries_strength(const CompositeMode& mode, const CompositeState& s) const;
};

}  // namespace vitrum
