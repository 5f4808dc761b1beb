#pragma once
#include "materials/composite/mode.hpp"

namespace vitrum {

/// The equations of one mode of the composite: only what the mode changes is an unknown, everything else
/// follows from it.
class ModeProblem final : public ModeEquations {
 public:
  /// The mode goes on from `state` at `fraction` of the path. The arguments must outlive the problem.
  ModeProblem(const CompositeModes& law, const CompositeMode& mode, const StrainPath& path,
              const CompositeState& state, double fraction);

  std::size_t size() const override { return size_; }
  double parameter_end() const override { return parameter_end_; }
  double parameter_scale() const override { return 1.0 - start_fraction_; }
  /// Decohesion with a viscosity, and plastic flow whose stress turns to the direction of the strain within a
  /// small part of the path (2G |eps'| >> |s|: nearly no strength left).
  bool stiff() const override;
  void initial(double* y) const override;
  bool rates(double parameter, const double* y, double* rates) const override;
  /// Of decohesion with a viscosity alone.
  bool has_jacobian() const override { return mode_.decohering() && mode_.viscous && !mode_.flowing; }
  void jacobian(double parameter, const double* y, double* columns) const override;
  void guards(double parameter, const double* y, Guards& guards) const override;
  void project(double parameter, double* y) const override;
  /// Parts of a tensor or a vector and energies are judged by the size of the whole, which their scale is: a
  /// component that happens to vanish needs no more digits than the others. The tolerance of the elastic
  /// deviator is at most 0.03 of its size at the start, and that of plastic dissipation what such a stress
  /// does on the whole increment.
  void absolute_tolerances(double relative, double absolute, double* tolerances) const override;
  const char* name(std::size_t unknown) const override;

  /// What y stands for.
  CompositeState state(double parameter, const double* y) const;
  double fraction(double parameter, const double* y) const;
  /// Energies dissipated since the start of the mode, J/m^3.
  Dissipation dissipation(const double* y) const;

 private:
  enum Unknown : unsigned char {
    mean_strain,  ///< elastic strain: trace / 3, and the deviator, whose tt follows
    deviator_rr,
    deviator_zz,
    deviator_rz,
    plastic_strain,
    crack_density,
    decohesion,
    opening_n,
    opening_t,
    plastic,
    damage,
    fracture,
    fraction_of_path,
    unknown_count
  };
  using Values = std::array<double, unknown_count>;  ///< by Unknown, in SI units

  /// Of a state, or of its rates; energies and the fraction are 0.
  template <class Of>
  static Values state_values(const Of& of);
  static Values rate_values(const CompositeRates& r);
  /// What y stands for; what is no unknown has the value of the start.
  Values values(const double* y) const;
  static bool is_deviator(Unknown u) { return u >= deviator_rr && u <= deviator_rz; }
  /// Whether it is no part of a tensor or vector, nor an energy.
  static bool is_alone(Unknown u) {
    return u == plastic_strain || u == crack_density || u == decohesion || u == fraction_of_path;
  }
  static bool is_settled(Unknown u) { return u <= opening_t && u != crack_density; }
  void add(Unknown unknown, double scale) { unknowns_[size_] = unknown, scales_[size_++] = scale; }

  const CompositeModes& law_;
  const CompositeMode& mode_;
  const StrainPath& path_;
  const CompositeState& start_;
  double start_fraction_, parameter_end_;
  bool fraction_is_unknown_;
  Values start_values_;
  std::size_t size_ = 0;
  std::array<Unknown, unknown_count> unknowns_{};
  std::array<double, unknown_count> scales_{};
};

}  // namespace vitrum
