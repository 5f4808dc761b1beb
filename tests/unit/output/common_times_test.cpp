#include <cmath>
#include <limits>
#include <random>

#include "output/compare.hpp"
#include "tests/catch.hpp"

using namespace vitrum::output;

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

TEST_CASE("Outputs at the same times are paired one by one, wherever the time is", "[output]") {
  std::mt19937 random(7);
  for (const double start : {-15e-6, 0.0, 1e-3, 1.0, 1000.0, 1e6})
    for (const double interval : {1e-8, 1e-6, 1e-3}) {
      if (interval < 100.0 * std::numeric_limits<double>::epsilon() * start) continue;
      std::vector<double> a, b;
      Pairs expected;
      for (std::size_t n = 0; n < 200; ++n) {
        a.push_back(start + interval * static_cast<double>(n));
        if (random() % 3 == 0) continue;
        expected.emplace_back(n, b.size());
        // What rounding makes of the same time.
        b.push_back(random() % 2 == 0 ? a.back() : std::nextafter(a.back(), 1e9));
      }
      CHECK(common_times(a, b) == expected);
    }
}

TEST_CASE("Times that are not common are not paired, and equal ones in their order", "[output]") {
  CHECK(common_times(std::vector{0.0, 1.0, 2.0}, std::vector{0.5, 1.5}).empty());
  CHECK(common_times(std::vector{0.0, 1.0, 1.0, 2.0}, std::vector{0.0, 1.0, 1.0, 2.0}) ==
        Pairs{{0, 0}, {1, 1}, {2, 2}, {3, 3}});
  CHECK(common_times(std::vector{5.0}, std::vector{0.0, 5.0, 6.0}) == Pairs{{0, 1}});
  CHECK(common_times(std::vector<double>{}, std::vector{1.0}).empty());
}
