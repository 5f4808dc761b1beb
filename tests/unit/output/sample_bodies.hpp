#pragma once
#include <stdexcept>
#include <utility>

#include "mpm/particles.hpp"

namespace vitrum::output {

/// A material that only has variables: what the output layer sees of one. Its damage is twice the crack
/// density, its stress 10 less than its strain.
class DescribedMaterial final : public Material {
 public:
  DescribedMaterial(MaterialParameters parameters, std::vector<VariableInfo> variables)
      : parameters_(std::move(parameters)), variables_(std::move(variables)) {}

  const MaterialParameters& parameters() const override { return parameters_; }
  std::span<const VariableInfo> variables() const override { return variables_; }
  double damage(const PointState& state) const override { return 2.0 * state.crack_density; }
  double wave_speed() const override { throw std::logic_error("not for output"); }
  PointState initial_state(const SymmetricTensor&) const override {
    throw std::logic_error("not for output");
  }
  void judge(PointState&, PointReport&) const override { throw std::logic_error("not for output"); }
  void respond(PointState&, const SymmetricTensor&, double, PointReport&) const override {
    throw std::logic_error("not for output");
  }
  EvolutionMode enter(PointState&, const StrainPath&, PointReport&) const override {
    throw std::logic_error("not used");
  }
  void leave(EvolutionMode&, Root, PointState&, const StrainPath&, double, PointReport&) const override {}
  EvolutionRates rates(const EvolutionMode&, const PointState&, const StrainPath&) const override {
    return {};
  }
  OpeningJacobian opening_jacobian(const EvolutionMode&, const PointState&,
                                   const StrainPath&) const override {
    return {};
  }
  void events(const EvolutionMode&, const PointState&, const StrainPath&, EventFunctions&) const override {}
  void settle(const EvolutionMode&, PointState&, const StrainPath&) const override {}
  void respond(const ParticleColumns&, std::size_t, std::size_t, double, PointIntegrator*,
               BatchReport&) const override {
    throw std::logic_error("not for output");
  }
  TangentEntries tangent(const PointState&, const SymmetricTensor&, double) const override {
    throw std::logic_error("not for output");
  }
  void tangent(const ParticleColumns&, std::size_t, std::size_t, double, TangentEntries*) const override {
    throw std::logic_error("not for output");
  }
  Moduli secant_moduli(const PointState&) const override { throw std::logic_error("not for output"); }
  void stress(const std::array<const double*, 4>& strain, const double*, std::size_t size,
              const std::array<double*, 4>& stress) const override {
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < size; ++k) stress[c][k] = strain[c][k] - 10.0;
  }

 private:
  MaterialParameters parameters_;
  std::vector<VariableInfo> variables_;
};

inline Body sample_body(std::string name, const std::vector<Variable>& variables, bool damage,
                        std::vector<std::uint32_t> identity) {
  MaterialParameters parameters;
  if (damage) parameters.damage.emplace();
  std::vector<VariableInfo> infos;
  for (const Variable variable : variables)
    infos.push_back(all_variables()[static_cast<std::size_t>(variable)]);
  Body body{std::move(name), std::make_shared<DescribedMaterial>(parameters, infos), {}, 0.5e-3};
  Particles& particles = body.particles;
  particles.size = identity.size();
  particles.identity = std::move(identity);
  // Every number tells the quantity (its offset) and the particle (its identity).
  const auto fill = [&particles](std::vector<double>& column, double offset) {
    for (const std::uint32_t id : particles.identity) column.push_back(offset + 0.1 * id);
  };
  for (std::size_t c = 0; c < 2; ++c) fill(particles.position[c], 10.0 + static_cast<double>(c));
  for (std::size_t c = 0; c < 2; ++c) fill(particles.velocity[c], 20.0 + static_cast<double>(c));
  for (std::size_t c = 0; c < 4; ++c) fill(particles.elastic_strain[c], 40.0 + static_cast<double>(c));
  for (const Variable v : variables)
    fill(particles.variables[static_cast<std::size_t>(v)], 50.0 + static_cast<double>(v));
  fill(particles.mass, 1.0);
  return body;
}

/// A damaging body stored out of order, and one that only yields.
inline std::vector<Body> sample_bodies() {
  return {sample_body("plate", {Variable::crack_density, Variable::dissipated}, true, {2, 0, 1}),
          sample_body("cylinder", {Variable::plastic_strain, Variable::dissipated}, false, {1, 0})};
}

}  // namespace vitrum::output
