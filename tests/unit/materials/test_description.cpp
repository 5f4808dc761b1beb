#include <set>
#include <string>

#include "catch.hpp"
#include "materials/material.hpp"

using namespace vitrum;

namespace {

template <class Parameters>
void check_parameters() {
  std::set<std::string> names;
  for (const ParameterInfo<Parameters>& info : Parameters::describe()) {
    CAPTURE(std::string(info.name));
    CHECK_FALSE(info.name.empty());
    CHECK_FALSE(info.unit.empty());
    CHECK_FALSE(info.description.empty());
    CHECK(info.member != nullptr);
    CHECK(info.bounds.lowest < info.bounds.highest);
    if (info.fallback) CHECK(info.bounds.contain(*info.fallback));
    CHECK(names.insert(std::string(info.name)).second);
  }
  CHECK_FALSE(names.empty());
}

}  // namespace

TEST_CASE("every parameter has a name, a unit, a description and bounds around its default",
          "[material][description]") {
  check_parameters<ElasticParameters>();
  check_parameters<DamageParameters>();
  check_parameters<DruckerPragerParameters>();
  check_parameters<VonMisesParameters>();
  check_parameters<DecohesionParameters>();
}

TEST_CASE("every internal variable is described in the order of the enumeration", "[material][description]") {
  const auto all = all_variables();
  REQUIRE(all.size() == variable_count);
  std::set<std::string> names;
  const PointState initial;
  for (std::size_t i = 0; i < all.size(); ++i) {
    CAPTURE(std::string(all[i].name));
    CHECK(static_cast<std::size_t>(all[i].variable) == i);
    CHECK_FALSE(all[i].name.empty());
    CHECK_FALSE(all[i].unit.empty());
    CHECK_FALSE(all[i].description.empty());
    CHECK(all[i].scale > 0.0);
    CHECK(all[i].bounds.contain(initial.*variable_members[i]));
    CHECK(names.insert(std::string(all[i].name)).second);
  }
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
