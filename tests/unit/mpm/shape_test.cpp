#include <cmath>
#include <limits>

#include "catch.hpp"
#include "mpm/shape.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::mpm;
using vitrum::test::Random;

namespace {

constexpr double halves[] = {0.5, 0.25, 1.0 / 6.0, 0.125};

/// Calls f(kind as a constant, half) for every shape function and, for GIMP, every particle size.
template <class F>
void for_each_shape(F&& f) {
  f.template operator()<ShapeKind::linear>(0.5);
  f.template operator()<ShapeKind::bspline2>(0.5);
  for (const double half : halves) f.template operator()<ShapeKind::gimp>(half);
  for (const double half : {0.02, 0.25, 0.5, 0.7, 1.0}) f.template operator()<ShapeKind::cpgimp>(half);
}

/// Positions to try: on nodes, cell centres and particle-edge alignments, one rounding beside each, and
/// anywhere; both signs.
std::vector<double> positions() {
  std::vector<double> x;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const double node : {-1000.0, -3.0, -1.0, 0.0, 1.0, 2.0, 7.0, 8.0, 123456.0})
    for (const double part : {0.0, 0.125, 1.0 / 6.0, 0.25, 0.5, 0.75, 5.0 / 6.0, 0.875}) {
      const double at = node + part;
      x.insert(x.end(), {at, std::nextafter(at, infinite), std::nextafter(at, -infinite)});
    }
  Random random(3);
  for (int i = 0; i < 2000; ++i) x.push_back(random.uniform(-20.0, 20.0));
  return x;
}

double hat(double t) {
  return std::max(0.0, 1.0 - std::abs(t));
}

}  // namespace

TEST_CASE("Cell numbers are floors, for negative positions too", "[mpm][shape]") {
  for (const double x : positions()) REQUIRE(cell_of(x) == static_cast<long long>(std::floor(x)));
}

TEST_CASE("GIMP of particles as large as a cell is the quadratic B-spline, slopes too", "[mpm][shape]") {
  for (const double x : positions()) {
    const auto gimp = Shape1<ShapeKind::gimp>::at(x, 0.5), spline = Shape1<ShapeKind::bspline2>::at(x, 0.5);
    REQUIRE(gimp.first == spline.first);
    const double rounding = 4e-16 * std::max(1.0, std::abs(x));
    for (std::size_t k = 0; k < 3; ++k) {
      REQUIRE(std::abs(gimp.value[k] - spline.value[k]) <= rounding);
      REQUIRE(std::abs(gimp.slope[k] - spline.slope[k]) <= rounding);
    }
  }
}

TEST_CASE("GIMP of domains that stretch is GIMP where they have not, and ends within a tile",
          "[mpm][shape]") {
  for (const double x : positions()) {
    for (const double half : halves) {
      const auto fixed = Shape1<ShapeKind::gimp>::at(x, half);
      const auto stretched = Shape1<ShapeKind::cpgimp>::at(x, half);
      REQUIRE(stretched.first == fixed.first);
      for (std::size_t k = 0; k < 3; ++k) {
        REQUIRE(stretched.value[k] == fixed.value[k]);
        REQUIRE(stretched.slope[k] == fixed.slope[k]);
      }
      REQUIRE(std::abs(stretched.value[3]) < 1e-15 * std::max(10.0, std::abs(x)) / half);
    }
    // The nodes that a particle of cell c can touch end at c + 2, whatever its domain.
    for (const double half : {0.02, 0.3, 0.5, 0.7, 1.0}) {
      const auto w = Shape1<ShapeKind::cpgimp>::at(x, half),
                 within = Shape1<ShapeKind::cpgimp>::at(x, half, cell_of(x) - 1);
      const auto at = [](const Weights1<4>& of, std::int32_t node) {
        const std::int32_t k = node - of.first;
        return k < 0 || k > 3 ? 0.0 : of.value[static_cast<std::size_t>(k)];
      };
      REQUIRE(within.first + 3 <= cell_of(x) + 2);
      REQUIRE(within.first >= cell_of(x) - 1);
      for (std::int32_t node = cell_of(x) - 2; node <= cell_of(x) + 4; ++node)
        REQUIRE(std::abs(at(w, node) - at(within, node)) < 1e-15 * std::max(10.0, std::abs(x)) / half);
    }
  }
}

TEST_CASE("Shape functions: partition of unity, linear reproduction, no negative value", "[mpm][shape]") {
  for_each_shape([]<ShapeKind kind>(double half) {
    for (const double x : positions()) {
      const auto w = Shape1<kind>::at(x, half);
      double sum = 0.0, slopes = 0.0, position = 0.0, gradient = 0.0;
      for (std::size_t k = 0; k < Shape1<kind>::count; ++k) {
        const double node = static_cast<double>(w.first + static_cast<long long>(k));
        REQUIRE(w.value[k] >= 0.0);
        sum += w.value[k];
        slopes += w.slope[k];
        position += w.value[k] * (node - x);  // relative: the rounding of x itself is not the functions'
        gradient += w.slope[k] * (node - std::floor(x));
      }
      const double rounding = 1e-15 * std::max(10.0, std::abs(x));
      CAPTURE(static_cast<int>(kind), half, x);
      REQUIRE(std::abs(sum - 1.0) < rounding / half);
      REQUIRE(std::abs(slopes) < rounding / half);
      REQUIRE(std::abs(position) < rounding / half);
      REQUIRE(std::abs(gradient - 1.0) < rounding / half);
    }
  });
}

TEST_CASE("Shape function slopes are the derivatives of their values", "[mpm][shape]") {
  for_each_shape([]<ShapeKind kind>(double half) {
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
      const double x = random.uniform(-9.0, 9.0), d = 1e-5;
      const auto w = Shape1<kind>::at(x, half), right = Shape1<kind>::at(x + d, half),
                 left = Shape1<kind>::at(x - d, half);
      if (right.first != left.first) continue;  // a kink or a change of nodes in between
      for (std::size_t k = 0; k < Shape1<kind>::count; ++k) {
        CAPTURE(static_cast<int>(kind), half, x, k);
        // Central differences are exact for quadratics; a kink of the slope in between costs d / (2 half).
        REQUIRE(std::abs((right.value[k] - left.value[k]) / (2.0 * d) - w.slope[k]) < 1e-9 + d / half);
      }
    }
  });
}

TEST_CASE("Shape functions do not jump at nodes, edges and a rounding beside them", "[mpm][shape]") {
  for_each_shape([]<ShapeKind kind>(double half) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const auto value_at = [half](double x, long long node) {
      const auto w = Shape1<kind>::at(x, half);
      const long long k = node - w.first;
      return k < 0 || k >= Shape1<kind>::count ? 0.0 : w.value[static_cast<std::size_t>(k)];
    };
    for (const double x : {-2.0, -1.5, -1.0, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0, 1.5})
      for (long long node = -4; node <= 4; ++node) {
        const double here = value_at(x, node);
        CAPTURE(static_cast<int>(kind), half, x, node);
        REQUIRE(std::abs(value_at(std::nextafter(x, infinite), node) - here) < 1e-14);
        REQUIRE(std::abs(value_at(std::nextafter(x, -infinite), node) - here) < 1e-14);
      }
  });
}

TEST_CASE("Shape functions vanish beyond their support and have their textbook values", "[mpm][shape]") {
  const auto on_node = Shape1<ShapeKind::linear>::at(4.0, 0.5);
  CHECK(on_node.first == 4);
  CHECK(on_node.value[0] == Approx(1.0));
  CHECK(on_node.value[1] >
        0.0);  // never quite 0 where the slope is not: else that node might be empty and yet be read
  CHECK(on_node.value[1] < 2e-15);
  const auto middle = Shape1<ShapeKind::bspline2>::at(4.0, 0.5);
  CHECK(middle.first == 3);
  CHECK(middle.value[0] == Approx(0.125));
  CHECK(middle.value[1] == Approx(0.75));
  CHECK(middle.value[2] == Approx(0.125));
  // A GIMP particle strictly inside a cell touches that cell's nodes only, and there it is the linear
  // function.
  const auto inside = Shape1<ShapeKind::gimp>::at(4.4, 0.25);
  CHECK(inside.first == 4);
  CHECK(inside.value[0] == Approx(0.6));
  CHECK(inside.value[2] == 0.0);
  CHECK(inside.slope[2] == 0.0);
}

TEST_CASE("GIMP is the hat function averaged over the particle, by quadrature", "[mpm][shape]") {
  Random random(9);
  for (const double half : halves)
    for (int i = 0; i < 50; ++i) {
      const double x = random.uniform(-3.0, 3.0);
      const auto w = Shape1<ShapeKind::gimp>::at(x, half);
      for (std::size_t k = 0; k < 3; ++k) {
        const double node = static_cast<double>(w.first + static_cast<long long>(k));
        constexpr int points = 20000;
        double sum = 0.0;
        for (int q = 0; q < points; ++q) sum += hat(x - half + 2.0 * half * (q + 0.5) / points - node);
        CAPTURE(half, x, k);
        REQUIRE(std::abs(sum / points - w.value[k]) < 1e-8);
      }
    }
}
