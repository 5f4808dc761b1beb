#include <algorithm>

#include "catch.hpp"
#include "support/continuum_tangent.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

Tangent matrix(const TangentEntries& entries) {
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(entries.data());
}
SymmetricTensor stress_after(const CompositeMaterial& material, CompositeState s,
                             const SymmetricTensor& strain, double duration) {
  PointReport report;
  material.respond(s, strain, duration, report);
  return s.stress;
}

}  // namespace

TEST_CASE("consistent tangent of an elastic increment is Hooke's law, symmetric", "[material][tangent]") {
  Random random(60);
  for (const NamedMaterial& named : all_compositions()) {
    const auto material = composite_of(named.parameters, cell);
    const Tangent hooke = elastic_tangent(elastic_moduli(named.parameters.elastic));
    for (int i = 0; i < 50; ++i) {
      const SymmetricTensor strain = random.tensor(1e-7);
      const Tangent T = matrix(material->tangent(CompositeState{}, strain, 1e-3));
      CAPTURE(named.name);
      // Damage of such strains is of the order of their sixth power.
      REQUIRE((T - hooke).norm() < 1e-7 * hooke.norm());
      REQUIRE((T - T.transpose()).norm() < 1e-7 * hooke.norm());
    }
  }
}

TEST_CASE("consistent tangent of damage at a fixed rate is eq. 9", "[material][tangent][damage]") {
  MaterialParameters p = damaging_glass();
  p.damage->fixed_rate = 1.0e3;
  const auto glass = composite_of(p, cell);
  const DamageLaw law(*p.damage, p.elastic);
  Random random(61);
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    SymmetricTensor e = random.direction();
    if (trace(e) < 0.1) continue;
    const double x = random.uniform(0.01, 0.9);
    e *= 3.0 * law.strain_at(x * crack_density_limit, law.coefficient(1.0e3)) / trace(e);
    const Tangent exact = damage_tangent(law, x, e);
    const Tangent T = matrix(glass->tangent(CompositeState{}, e, 1e-6));
    REQUIRE((T - exact).norm() < 1e-7 * exact.norm());
    ++compared;
  }
  CHECK(compared > 100);
}

TEST_CASE("consistent tangent against differences of the response in random directions",
          "[material][tangent]") {
  Random random(62);
  for (const NamedMaterial& named : all_compositions()) {
    const auto material = composite_of(named.parameters, cell);
    int agree = 0;
    constexpr int cases = 300;
    for (int i = 0; i < cases; ++i) {
      const double duration = random.logarithmic(1e-7, 1e-3);
      const Driven at =
          drive(*material, {{random.logarithmic(1e-5, 3e-3) * random.direction(), duration}}, 1);
      const SymmetricTensor strain = random.logarithmic(1e-6, 1e-3) * random.direction();
      const SymmetricTensor along = random.direction();
      const double step = 2e-6 * std::max(norm(at.state.elastic_strain), norm(strain));
      const Eigen::Vector4d found =
          vector(stress_after(*material, at.state, strain + step * along, duration) -
                 stress_after(*material, at.state, strain - step * along, duration)) /
          (2.0 * step);
      const Eigen::Vector4d expected = matrix(material->tangent(at.state, strain, duration)) * vector(along);
      if ((found - expected).norm() < 1e-4 * elastic_moduli(named.parameters.elastic).p_wave()) ++agree;
    }
    CAPTURE(named.name, agree);
    CHECK(agree >= cases * 97 / 100);  // the others have a kink or a jump within a step
  }
}

TEST_CASE("consistent tangent is finite and bounded everywhere", "[material][tangent][extreme]") {
  Random random(63);
  for (const NamedMaterial& named : all_compositions()) {
    const auto material = composite_of(named.parameters, cell);
    // Steepest is damage just before its cap, and softening just before it turns into a snap-back: 12 found.
    const double bound = 30.0 * elastic_moduli(named.parameters.elastic).p_wave();
    for (int i = 0; i < 500; ++i) {
      const double duration = random.chance(0.1) ? 0.0 : random.logarithmic(1e-9, 1.0);
      const Driven at = drive(*material,
                              {{random.logarithmic(1e-6, 0.1) * random.direction(), 1e-6},
                               {random.logarithmic(1e-6, 0.1) * random.direction(), 2e-6}},
                              2);
      SymmetricTensor strain = random.logarithmic(1e-12, 0.1) * random.direction();
      if (random.chance(0.2)) strain = {};
      if (random.chance(0.2)) strain = -1.0 * at.state.elastic_strain;  // onto the kink at zero strain
      const Tangent T = matrix(material->tangent(at.state, strain, duration));
      CAPTURE(named.name, duration);
      REQUIRE(T.allFinite());
      REQUIRE(T.norm() <= bound);
    }
  }
}
