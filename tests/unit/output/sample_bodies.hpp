#pragma once
#include <stdexcept>
#include <utility>

#include "mpm/particles.hpp"

namespace vitrum::output {

/// A material that only has variables: what the output layer sees of one. Its damage is twice the crack
/// density, its stress 10 less than its strain.
class DescribedMaterial final : public Material {
 public:
  DescribedMaterial(std::vector<Variable> variables, bool damage)
      : Material({}, std::move(variables), true, {}, damage ? std::optional<std::size_t>(0) : std::nullopt) {}

  using Material::damage;
  double damage(double value) const override { return 2.0 * value; }
  double wave_speed() const override { throw std::logic_error("not for output"); }
  double strain_scale() const override { throw std::logic_error("not for output"); }
  PointState start(const SymmetricTensor&) const override { throw std::logic_error("not for output"); }
  void judge(PointState&, PointReport&) const override { throw std::logic_error("not for output"); }
  void advance(PointState&, const SymmetricTensor&, double, PointReport&) const override {
    throw std::logic_error("not for output");
  }
  void advance(const ParticleColumns&, std::size_t, std::size_t, double, PointIntegrator*,
               BatchReport&) const override {
    throw std::logic_error("not for output");
  }
  TangentEntries tangent(const PointState&, const SymmetricTensor&, double) const override {
    throw std::logic_error("not for output");
  }
  void tangent(const ParticleColumns&, std::size_t, std::size_t, double, TangentEntries*) const override {
    throw std::logic_error("not for output");
  }
  void stress(const TensorPointers<const double>& strain, const VariableColumns<const double*>&,
              std::size_t size, const TensorPointers<double>& stress) const override {
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < size; ++k) stress[c][k] = strain[c][k] - 10.0;
  }
  SymmetricTensor stress(const PointState&) const override { throw std::logic_error("not for output"); }
  double stored_energy(const PointState&) const override { throw std::logic_error("not for output"); }
};

/// `variable`: the one that the material stores besides `dissipated`.
inline Body sample_body(std::string name, const std::string& variable, bool damage,
                        std::vector<std::uint32_t> identity) {
  Body body{std::move(name),
            std::make_shared<DescribedMaterial>(
                std::vector<Variable>{{.name = variable, .unit = "1", .text = variable}}, damage),
            {},
            0.5e-3};
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
  particles.variables.resize(2);
  for (std::size_t k = 0; k < 2; ++k) fill(particles.variables[k], 50.0 + 10.0 * static_cast<double>(k));
  fill(particles.mass, 1.0);
  return body;
}

/// A damaging body stored out of order, and one that only yields.
inline std::vector<Body> sample_bodies() {
  return {sample_body("plate", "crack_density", true, {2, 0, 1}),
          sample_body("cylinder", "plastic_strain", false, {1, 0})};
}

}  // namespace vitrum::output
