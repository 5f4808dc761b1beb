#include <cmath>

#include "catch.hpp"
#include "support/composite_material.hpp"
#include "support/material_samples.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

SymmetricTensor mirrored(const SymmetricTensor& a) {
  return {a.rr, a.zz, a.tt, -a.rz};
}

}  // namespace

// A mirror image of a history is a possible history: the choice between conjugate shear planes must not
// prefer a side.
TEST_CASE("the mirror image of a path has the mirror image of its crack", "[material][decohesion]") {
  const std::shared_ptr<const CompositeMaterial> steel = composite_of(fracturing_steel(), 1.0e-3);
  int localised = 0;
  for (int i = 0; i < 500; ++i) {
    // Directions all around, none with the principal axes along r and z, where both planes face z alike.
    const double angle = 0.1 + 0.0123 * i, out = 0.03 * std::sin(0.7 * i);
    const SymmetricTensor strain{0.04 * std::cos(angle), -0.04 * std::cos(angle), out,
                                 0.04 * std::sin(angle) + 0.011};
    CompositeState one, other;
    PointReport a, b;
    steel->respond(one, strain, 1.0e-6, a);
    steel->respond(other, mirrored(strain), 1.0e-6, b);
    CAPTURE(i, one.normal.r, one.normal.z, other.normal.r, other.normal.z);
    REQUIRE(is_localised(one) == is_localised(other));
    if (!is_localised(one)) continue;
    ++localised;
    // n and -n are the same plane.
    REQUIRE(std::abs(one.normal.r * other.normal.z + one.normal.z * other.normal.r) < 1e-12);
    REQUIRE(norm(one.stress - mirrored(other.stress)) < 1e-3);
  }
  CHECK(localised > 100);
}
