#include <set>
#include <string>

#include "catch.hpp"
#include "materials/johnson_cook.hpp"
#include "materials/johnson_holmquist.hpp"
#include "materials/maxwell.hpp"
#include "schema/field.hpp"

using namespace vitrum;

namespace {

template <class Parameters>
void check_rows() {
  std::set<std::string> names;
  for (const schema::Field<Parameters>& row : Parameters::rows()) {
    CAPTURE(row.name);
    CHECK_FALSE(row.name.empty());
    CHECK_FALSE(row.unit.empty());
    CHECK_FALSE(row.text.empty());
    CHECK(row.bounds.lowest < row.bounds.highest);
    if (const double* fallback = row.fallback ? std::get_if<double>(&*row.fallback) : nullptr)
      CHECK(row.bounds.contain(*fallback));
    // What is neither required nor has a default says what its absence means.
    CHECK((row.required || row.fallback || row.text.find("absent") != std::string::npos));
    CHECK_FALSE((row.required && row.fallback));
    CHECK(names.insert(row.name).second);
  }
  CHECK_FALSE(names.empty());
}

}  // namespace

TEST_CASE("every parameter has a name, a unit, a description and bounds around its default",
          "[material][description]") {
  check_rows<ElasticParameters>();
  check_rows<DamageParameters>();
  check_rows<DruckerPragerParameters>();
  check_rows<VonMisesParameters>();
  check_rows<DecohesionParameters>();
  check_rows<JohnsonCookParameters>();
  check_rows<JohnsonHolmquistParameters>();
  check_rows<MaxwellParameters>();
}

TEST_CASE("every column is described, and named once", "[material][description]") {
  std::set<std::string> names;
  for (const Component& column : all_columns()) {
    CAPTURE(column.name);
    CHECK_FALSE(column.name.empty());
    CHECK_FALSE(column.unit.empty());
    CHECK_FALSE(column.text.empty());
    CHECK(column.scale > 0.0);
    CHECK(column.bounds.contain(column.initial));
    CHECK(names.insert(column.name).second);
  }
}

TEST_CASE("components of a vector and of a tensor have names and signs of their own",
          "[material][description]") {
  const std::vector<Variable> variables{
      {.name = "a", .unit = "1", .text = "a"},
      {.name = "v", .unit = "1", .text = "v", .kind = Kind::vector},
      {.name = "t", .unit = "1", .text = "t", .kind = Kind::symmetric, .parity = Parity::odd},
      {.name = "b", .unit = "1", .text = "b", .parity = Parity::odd}};
  std::string names, signs;
  for (const Component& c : components_of(variables)) names += c.name + ' ', signs += c.flips ? '-' : '+';
  CHECK(names == "a v_r v_z t_rr t_zz t_tt t_rz b ");
  CHECK(signs == "+-+---+-");
}

TEST_CASE("open and closed ends of bounds", "[material][description]") {
  const Bounds half_open{0.0, 1.0, true, false};
  CHECK_FALSE(half_open.contain(0.0));
  CHECK(half_open.contain(1.0));
  CHECK_FALSE(half_open.contain(1.1));
  const Bounds other{0.0, 1.0, false, true};
  CHECK(other.contain(0.0));
  CHECK_FALSE(other.contain(1.0));
}

TEST_CASE("every event has a name of its own", "[material][description]") {
  std::set<std::string_view> names;
  for (const EventKind kind : {EventKind::damage, EventKind::yield, EventKind::peak, EventKind::localisation,
                               EventKind::separation, EventKind::closure})
    CHECK(names.insert(event_name(kind)).second);
}
