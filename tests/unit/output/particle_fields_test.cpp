#include "output/particle_fields.hpp"

#include <cmath>
#include <numbers>

#include "contains_text.hpp"
#include "sample_bodies.hpp"
#include "scene/input_error.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::output;
using Names = std::vector<std::string>;

namespace {
Field only(const std::string& name, Geometry geometry = Geometry::axisymmetric) {
  const std::vector<Body> bodies = sample_bodies();
  return particle_fields(bodies, Names{name}, geometry).front();
}
void check_values(const std::vector<double>& found, const std::vector<double>& expected) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    CHECK((std::isnan(expected[i]) ? std::isnan(found[i]) : found[i] == Approx(expected[i])));
}
}  // namespace

TEST_CASE("Fields come body after body in the order of identities", "[output]") {
  check_values(only("position").values, {10.0, 11.0, 10.1, 11.1, 10.2, 11.2, 10.0, 11.0, 10.1, 11.1});
  CHECK(only("position").components == 2);
  const Field stress = only("stress");
  CHECK(stress.components == 4);
  CHECK(stress.unit == "Pa");
  CHECK(stress.values[4] == Approx(30.1));
  CHECK_THAT(stress.description, contains_text("(rr, zz, tt, rz)"));
  CHECK_THAT(only("stress", Geometry::plane_strain).description, contains_text("(xx, yy, zz, xy)"));
  CHECK(only("velocity").values[1] == Approx(21.0));
  CHECK(only("elastic_strain").values[3] == Approx(43.0));
}

TEST_CASE("What a body's material does not model is NaN", "[output]") {
  const double none = std::nan("");
  check_values(only("crack_density").values, {50.0, 50.1, 50.2, none, none});
  check_values(only("damage").values, {100.0, 100.2, 100.4, none, none});
  check_values(only("plastic_strain").values, {none, none, none, 50.0, 50.1});
  check_values(only("dissipated").values, {60.0, 60.1, 60.2, 60.0, 60.1});
}

TEST_CASE("The fields of a run are those of its materials or those asked for", "[output]") {
  const std::vector<Body> bodies = sample_bodies();
  const std::vector<const Material*> materials = materials_of(bodies);
  const Names standard = {"position",      "velocity",       "stress",    "damage",
                          "crack_density", "plastic_strain", "dissipated"};
  CHECK(select_fields({}, materials, "here") == standard);
  CHECK(select_fields(Names{"elastic_strain", "velocity", "velocity"}, materials, "here") ==
        Names{"position", "elastic_strain", "velocity"});
  CHECK(select_fields(Names{}, materials, "here") == Names{"position"});
  CHECK_THROWS_AS(select_fields(Names{"opening_n"}, materials, "here"), InputError);
  try {
    select_fields(Names{"velocity", "presure", "opening_n"}, materials, "here");
    FAIL("unknown fields were accepted");
  } catch (const InputError& error) {
    REQUIRE(error.messages().size() == 2);
    CHECK_THAT(error.messages()[0],
               contains_text("here: ") && contains_text("\"presure\"") && contains_text("plastic_strain"));
  }
}

TEST_CASE("Constant particle data name the body and hold masses of whole rings", "[output]") {
  const std::vector<Body> bodies = sample_bodies();
  const ParticleConstants axisymmetric = particle_constants(bodies, Geometry::axisymmetric);
  CHECK(axisymmetric.bodies == Names{"plate", "cylinder"});
  CHECK(axisymmetric.body == std::vector<std::uint32_t>{0, 0, 0, 1, 1});
  CHECK(axisymmetric.mass[1] == Approx(2.0 * std::numbers::pi * 1.1));
  CHECK(axisymmetric.mass_unit == "kg");
  CHECK(particle_constants(bodies, Geometry::plane_strain).mass[1] == Approx(1.1));
  CHECK(particle_constants(bodies, Geometry::plane_strain).mass_unit == "kg/m");
}
