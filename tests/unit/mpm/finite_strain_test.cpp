#include "mpm/finite_strain.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "catch.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;
using mpm::FiniteStrain;

namespace {

std::array<double, 5> random_gradient(Random& random, double size) {
  std::array<double, 5> g{};
  for (double& x : g) x = random.uniform(-size, size);
  return g;
}

}  // namespace

TEST_CASE("Finite strain is the polar decomposition", "[mpm]") {
  Random random(3);
  for (int k = 0; k < 2000; ++k) {
    const double angle = random.uniform(-3.0, 3.0), c = std::cos(angle), s = std::sin(angle);
    const auto g0 = random_gradient(random, 0.4);
    Eigen::Matrix2d R, F;
    R << c, -s, s, c;
    F << 1.0 + g0[0], g0[1], g0[2], 1.0 + g0[3];
    F = R * F;
    const FiniteStrain strain({F(0, 0) - 1.0, F(0, 1), F(1, 0), F(1, 1) - 1.0, g0[4]});
    const Eigen::JacobiSVD<Eigen::Matrix2d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix2d V = svd.matrixV(), U = V * svd.singularValues().asDiagonal() * V.transpose(),
                          turned = svd.matrixU() * V.transpose();
    REQUIRE(strain.strain().rr == Approx(U(0, 0) - 1.0).margin(1e-13));
    REQUIRE(strain.strain().zz == Approx(U(1, 1) - 1.0).margin(1e-13));
    REQUIRE(strain.strain().rz == Approx(U(0, 1)).margin(1e-13));
    REQUIRE(strain.strain().tt == g0[4]);
    REQUIRE(std::cos(strain.turn()) == Approx(turned(0, 0)).margin(1e-13));
    REQUIRE(std::sin(strain.turn()) == Approx(turned(1, 0)).margin(1e-13));
  }
}

TEST_CASE("A rotation strains nothing, and small strains keep their digits", "[mpm]") {
  for (const double angle : {1e-9, 1e-3, 0.5, 2.0, -3.1}) {
    const double c = std::cos(angle), s = std::sin(angle);
    const FiniteStrain strain({c - 1.0, -s, s, c - 1.0, 0.0});
    CHECK(norm(strain.strain()) < 1e-14);
    CHECK(strain.turn() == Approx(angle).epsilon(1e-12));
  }
  const FiniteStrain small({1e-12, 3e-12, -1e-12, -2e-12, 0.0});
  CHECK(small.strain().rr == Approx(1e-12).epsilon(1e-11));
  CHECK(small.strain().zz == Approx(-2e-12).epsilon(1e-11));
  CHECK(small.strain().rz == Approx(1e-12).epsilon(1e-11));
}

TEST_CASE("Change of strain against central differences; nominal stress is its adjoint", "[mpm]") {
  Random random(5);
  for (int k = 0; k < 500; ++k) {
    const auto g = random_gradient(random, 0.5), d = random_gradient(random, 1.0);
    const FiniteStrain strain(g);
    const auto at = [&](double h) {
      auto shifted = g;
      for (std::size_t i = 0; i < 5; ++i) shifted[i] += h * d[i];
      return FiniteStrain(shifted).strain();
    };
    constexpr double h = 1e-6;
    const SymmetricTensor difference = (0.5 / h) * (at(h) - at(-h)), change = strain.change(d);
    REQUIRE(norm(difference - change) < 1e-8 * (1.0 + norm(change)));
    const SymmetricTensor stress{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                 random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    const auto P = strain.nominal(stress);
    REQUIRE(P[0] * d[0] + P[1] * d[1] + P[2] * d[2] + P[3] * d[3] + stress.tt * d[4] ==
            Approx(contract(stress, change)).margin(1e-13));
  }
}
