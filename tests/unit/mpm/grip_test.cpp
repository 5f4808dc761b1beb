#include "mpm/contact/grip.hpp"

#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum::mpm;
using vitrum::test::Random;

TEST_CASE("A spring of friction gives back or makes heat of all work that is done on it", "[contact]") {
  Random random(41);
  for (int n = 0; n < 2000; ++n) {
    const double stiffness = random.uniform(0.5, 2.0), bound = random.uniform(0.1, 1.0);
    const Spring before{random.uniform(-bound, bound), stiffness};
    const double way = random.uniform(-2.0, 2.0);
    // Work on the spring along the way: the mean force while it stretches, the bound while it slides.
    constexpr int parts = 4000;
    double work = 0.0, lost = 0.0;
    Spring spring = before;
    for (int k = 0; k < parts; ++k) {
      const Stretched next = stretch(spring, stiffness, bound, way / parts);
      work -= 0.5 * (spring.force + next.spring.force) * way / parts;
      lost += next.lost, spring = next.spring;
    }
    const Stretched once = stretch(before, stiffness, bound, way);
    CHECK(once.spring.force == Approx(spring.force).margin(1e-12));
    CHECK(once.lost == Approx(lost).margin(1e-3));
    CHECK(work == Approx(once.spring.energy() - before.energy() + once.lost).margin(1e-3));
    CHECK(std::abs(once.spring.force) <= bound);
  }
}

TEST_CASE("No heat of friction is negative, whatever happens to the spring", "[contact]") {
  Random random(43);
  for (int n = 0; n < 5000; ++n) {
    const Spring before{random.uniform(-1.0, 1.0), random.uniform(0.0, 2.0)};
    const double stiffness = n % 5 == 0 ? 0.0 : random.uniform(0.0, 2.0), bound = random.uniform(0.0, 1.0);
    const Stretched still = stretch(before, stiffness, bound, 0.0);
    CHECK(still.lost >= 0.0);
    CHECK(still.spring.energy() + still.lost == Approx(before.energy()).margin(1e-12));
    CHECK(stretch(before, stiffness, bound, random.uniform(-1.0, 1.0)).lost >= 0.0);
  }
}

TEST_CASE("A spring that nothing has happened to keeps its bits", "[contact]") {
  Random random(47);
  for (int n = 0; n < 1000; ++n) {
    const double stiffness = random.uniform(0.1, 9.0), bound = random.uniform(0.1, 1.0);
    const Stretched first = stretch({0.0, stiffness}, stiffness, bound, random.uniform(-1.0, 1.0));
    const Stretched again = stretch(first.spring, stiffness, bound, 0.0);
    CHECK(again.spring.force == first.spring.force);
    CHECK(again.lost == 0.0);
  }
}
