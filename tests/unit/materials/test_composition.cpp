#include <set>
#include <stdexcept>

#include "catch.hpp"
#include "support/material_samples.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("a material stores only the variables of its models", "[material][composition]") {
  for (const NamedMaterial& named : all_compositions()) {
    CAPTURE(named.name);
    const MaterialParameters& p = named.parameters;
    const auto material = make_material(p, cell);
    std::set<Variable> stored;
    for (const VariableInfo& info : material->variables()) stored.insert(info.variable);
    const bool yields = p.von_mises || p.drucker_prager;
    CHECK(stored.count(Variable::crack_density) == (p.damage ? 1U : 0U));
    CHECK(stored.count(Variable::max_rate) == (p.damage ? 1U : 0U));
    CHECK(stored.count(Variable::plastic_strain) == (yields ? 1U : 0U));
    for (const Variable v :
         {Variable::decohesion, Variable::opening_n, Variable::opening_t, Variable::normal_r,
          Variable::normal_z, Variable::effective_length, Variable::cohesive_strength})
      CHECK(stored.count(v) == (p.decohesion ? 1U : 0U));
    CHECK(stored.count(Variable::dissipated) == (p.damage || yields || p.decohesion ? 1U : 0U));
  }
}

TEST_CASE("two yield laws at once are refused", "[material][composition]") {
  MaterialParameters p = bare_glass();
  p.von_mises = steel_von_mises();
  p.drucker_prager = glass_drucker_prager();
  CHECK_THROWS_AS(make_material(p, cell), std::invalid_argument);
}

TEST_CASE("wave speeds of the paper's glass and steel", "[material][composition]") {
  CHECK(make_material(bare_glass(), cell)->wave_speed() == Approx(5879.0).epsilon(1e-4));
  CHECK(make_material(bare_steel(), cell)->wave_speed() == Approx(5477.0).epsilon(1e-4));
}

TEST_CASE("initial state carries the given stress", "[material][composition]") {
  const SymmetricTensor stress{-3.0e6, 1.0e6, 2.0e6, 0.7e6};
  const auto material = make_material(fracturing_glass(), cell);
  const PointState s = material->initial_state(stress);
  CHECK(s.stress == stress);
  CHECK(norm(material->secant_moduli(s).stress(s.elastic_strain) - stress) < 1e-8);
  // Hooke's law written for the strain: e = ((1 + nu) sigma - nu tr(sigma) I) / E.
  CHECK(s.elastic_strain.rr == Approx((1.25 * -3.0e6 - 0.25 * 0.0) / 72.0e9));
  CHECK(s.elastic_strain.rz == Approx(1.25 * 0.7e6 / 72.0e9));
}
