#include "catch.hpp"
#include "support/continuum_tangent.hpp"
#include "support/literal_damage.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// d(stress) along `direction` from a loading state, by one-sided differences with one Richardson
/// extrapolation.
Eigen::Vector4d stress_rate(const CompositeMaterial& material, const CompositeState& at,
                            const SymmetricTensor& direction, double h, double rate) {
  const auto stress_after = [&](double step) {
    CompositeState s = at;
    PointReport report;
    const double growth = trace(direction) * step / 3.0;
    material.respond(s, step * direction, rate > 0.0 ? growth / rate : 1.0, report);
    return vector(s.stress);
  };
  const Eigen::Vector4d start = vector(at.stress);
  const Eigen::Vector4d once = (stress_after(h) - start) / h,
                        half = (stress_after(0.5 * h) - start) / (0.5 * h);
  const Eigen::Vector4d quarter = (stress_after(0.25 * h) - start) / (0.25 * h);
  const Eigen::Vector4d a = 2.0 * half - once, b = 2.0 * quarter - half;
  return (4.0 * b - a) / 3.0;
}

}  // namespace

TEST_CASE("elastic tangent is Hooke's law", "[material][tangent]") {
  const Moduli m{48.0e9, 28.8e9};
  const Tangent T = elastic_tangent(m);
  Random random(50);
  for (int i = 0; i < 50; ++i) {
    const SymmetricTensor e = random.tensor(1e-3);
    REQUIRE((T * vector(e) - vector(m.stress(e))).norm() < 1e-12 * vector(m.stress(e)).norm());
  }
}

TEST_CASE("damage tangent against the literal law and against the response", "[material][tangent][damage]") {
  const auto glass = composite_of(damaging_glass(), cell);
  const DamageLaw law(glass_damage(), bare_glass().elastic);
  const double rate = 1.0e3, C = literal_glass().coefficient(rate);
  Random random(51);
  for (int i = 0; i < 300; ++i) {
    SymmetricTensor direction = random.direction();
    if (trace(direction) < 0.0) direction *= -1.0;
    if (trace(direction) < 0.1) continue;
    const double x = random.uniform(0.01, 0.95);
    const double mean = std::pow(x * crack_density_limit / C, 1.0 / 6.0);
    const SymmetricTensor e = (3.0 * mean / trace(direction)) * direction;
    const Tangent T = damage_tangent(law, x, e);
    const auto literal = literal_glass().tangent(e, C);
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c)
        REQUIRE(std::abs(T(r, c) - literal[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)]) <
                1e-10 * T.norm());

    const Driven at = drive(*glass, {{e, mean / rate}}, 1);
    SymmetricTensor loading = random.direction();
    if (trace(loading) < 0.0) loading *= -1.0;
    if (trace(loading) < 0.1) continue;
    const Eigen::Vector4d expected = T * vector(loading);
    const Eigen::Vector4d found = stress_rate(*glass, at.state, loading, 1e-5 * norm(e), rate);
    REQUIRE((found - expected).norm() < 1e-7 * T.norm());
  }
}

TEST_CASE("von Mises tangent against the response", "[material][tangent][von_mises]") {
  const auto steel = composite_of(flowing_steel(), cell);
  const VonMisesLaw law(steel_von_mises());
  const Moduli moduli{130.0e9, 78.0e9};
  Random random(52);
  for (int i = 0; i < 300; ++i) {
    const SymmetricTensor n = random.deviatoric_direction();
    const Driven at = drive(
        *steel, {{random.uniform(2.5e-3, 0.03) * n + random.uniform(-1e-3, 1e-3) * identity(), 1.0}}, 1);
    const double distance_to_kink = std::abs(at.state.plastic_strain - law.peak_strain());
    if (at.state.plastic_strain == 0.0 || distance_to_kink < 1e-5) continue;
    SymmetricTensor loading = random.direction();
    if (contract(loading, n) < 0.0) loading *= -1.0;
    if (contract(loading, n) < 0.05) continue;
    const Tangent T = von_mises_tangent(law, moduli, at.state.stress, at.state.plastic_strain);
    const Eigen::Vector4d found = stress_rate(*steel, at.state, loading, 1e-6, 0.0);
    REQUIRE((found - T * vector(loading)).norm() < 1e-7 * T.norm());
    // Elastic unloading from the same state: Hooke's law.
    const Eigen::Vector4d back = stress_rate(*steel, at.state, -1.0 * loading, 1e-6, 0.0);
    REQUIRE((back + elastic_tangent(moduli) * vector(loading)).norm() < 1e-7 * T.norm());
  }
}

TEST_CASE("Drucker-Prager tangent against the response", "[material][tangent][drucker_prager]") {
  Random random(53);
  const Moduli moduli{48.0e9, 28.8e9};
  for (const bool associated : {false, true}) {
    MaterialParameters p = bare_glass();
    p.drucker_prager = glass_drucker_prager();
    p.drucker_prager->associated = associated;
    const auto glass = composite_of(p, cell);
    int compared = 0;
    for (int i = 0; i < 400; ++i) {
      const SymmetricTensor strain =
          random.uniform(5e-3, 1e-2) * random.deviatoric_direction() - 1e-3 * identity();
      const Driven at = drive(*glass, {{strain, 1.0}}, 1);
      if (at.state.plastic_strain == 0.0) continue;
      const Tangent T = drucker_prager_tangent(*p.drucker_prager, moduli, at.state.stress);
      SymmetricTensor loading = random.direction();
      const SymmetricTensor s = deviator(at.state.stress);
      const double q = std::sqrt(1.5 * contract(s, s));
      const auto growth = [&] {  // of the yield function at an elastic rate
        return 3.0 * moduli.shear / q * contract(s, loading) + 1.8 * moduli.bulk * trace(loading);
      };
      if (growth() < 0.0) loading *= -1.0;
      if (growth() < 0.1 * moduli.bulk) continue;
      ++compared;
      const Eigen::Vector4d found = stress_rate(*glass, at.state, loading, 1e-6, 0.0);
      REQUIRE((found - T * vector(loading)).norm() < 1e-7 * T.norm());
    }
    CHECK(compared > 100);
  }
}
