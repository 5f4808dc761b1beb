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
    const auto material = composite_of(p, cell);
    std::set<std::string> stored;
    for (const Component& column : material->columns()) stored.insert(column.name);
    const bool yields = p.von_mises || p.drucker_prager;
    CHECK(stored.count("crack_density") == (p.damage ? 1U : 0U));
    CHECK(stored.count("max_rate") == (p.damage ? 1U : 0U));
    CHECK(stored.count("plastic_strain") == (yields ? 1U : 0U));
    for (const char* v : {"decohesion", "opening_n", "opening_t", "normal_r", "normal_z", "effective_length",
                          "cohesive_strength"})
      CHECK(stored.count(v) == (p.decohesion ? 1U : 0U));
    CHECK(stored.count("dissipated") == (p.damage || yields || p.decohesion ? 1U : 0U));
  }
}

TEST_CASE("two yield laws at once are refused", "[material][composition]") {
  MaterialParameters p = bare_glass();
  p.von_mises = steel_von_mises();
  p.drucker_prager = glass_drucker_prager();
  CHECK_THROWS_AS(composite_of(p, cell), std::invalid_argument);
}

TEST_CASE("wave speeds of the paper's glass and steel", "[material][composition]") {
  CHECK(composite_of(bare_glass(), cell)->wave_speed() == Approx(5879.0).epsilon(1e-4));
  CHECK(composite_of(bare_steel(), cell)->wave_speed() == Approx(5477.0).epsilon(1e-4));
}

TEST_CASE("initial state carries the given stress", "[material][composition]") {
  const SymmetricTensor stress{-3.0e6, 1.0e6, 2.0e6, 0.7e6};
  const auto material = composite_of(fracturing_glass(), cell);
  const CompositeState s = material->initial_state(stress);
  CHECK(s.stress == stress);
  CHECK(norm(material->secant_moduli(s).stress(s.elastic_strain) - stress) < 1e-8);
  // Hooke's law written for the strain: e = ((1 + nu) sigma - nu tr(sigma) I) / E.
  CHECK(s.elastic_strain.rr == Approx((1.25 * -3.0e6 - 0.25 * 0.0) / 72.0e9));
  CHECK(s.elastic_strain.rz == Approx(1.25 * 0.7e6 / 72.0e9));
}
