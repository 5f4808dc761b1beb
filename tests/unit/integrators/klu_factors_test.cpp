#include "integrators/sundials/klu_factors.hpp"

#include <Eigen/Dense>
#include <limits>

#include "catch.hpp"
#include "support/random_states.hpp"

using namespace vitrum::test;
using vitrum::sundials::KluFactors;
using vitrum::sundials::SparsePattern;

namespace {

/// The nodes of a square grid with two unknowns each, coupled to their neighbours.
SparsePattern grid_pattern(int side) {
  SparsePattern pattern;
  pattern.column.push_back(0);
  for (int column = 0; column < 2 * side * side; ++column) {
    for (int row = 0; row < 2 * side * side; ++row) {
      const int a = column / 2, b = row / 2;
      if (std::abs(a % side - b % side) <= 1 && std::abs(a / side - b / side) <= 1)
        pattern.row.push_back(row);
    }
    pattern.column.push_back(static_cast<std::int64_t>(pattern.row.size()));
  }
  return pattern;
}

Eigen::MatrixXd dense(const SparsePattern& pattern, const std::vector<double>& values) {
  const auto n = static_cast<Eigen::Index>(pattern.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t column = 0; column < pattern.size(); ++column)
    for (auto k = static_cast<std::size_t>(pattern.column[column]);
         k < static_cast<std::size_t>(pattern.column[column + 1]); ++k)
      matrix(pattern.row[k], static_cast<Eigen::Index>(column)) = values[k];
  return matrix;
}

}  // namespace

TEST_CASE("KLU solves with matrices of one pattern, whatever became of the last pivots", "[integrators]") {
  const SparsePattern pattern = grid_pattern(7);
  KluFactors factors(pattern);
  CHECK(factors.entries() == 0);
  Random random(31);
  for (int matrix = 0; matrix < 20; ++matrix) {
    // Without a diagonal that rules, of any size: what was a good pivot is a bad one in the next matrix.
    std::vector<double> values(pattern.row.size());
    for (double& v : values) v = random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-6.0, 6.0));
    const Eigen::MatrixXd A = dense(pattern, values);
    REQUIRE(factors.factor(values.data()) == KluFactors::Outcome::done);
    Eigen::VectorXd b(A.rows());
    for (double& v : b) v = random.uniform(-1.0, 1.0);
    Eigen::VectorXd x = b;
    factors.solve(x.data());
    // The residual, not the error: some of these matrices are next to singular.
    const double scale = A.cwiseAbs().maxCoeff() * x.cwiseAbs().maxCoeff();
    CAPTURE(matrix, scale);
    CHECK((A * x - b).cwiseAbs().maxCoeff() < 1e-9 * scale);
  }
  CHECK(factors.entries() > static_cast<std::int64_t>(pattern.row.size()));
}

TEST_CASE("KLU says that a matrix is singular, and solves with the next", "[integrators]") {
  const SparsePattern pattern = grid_pattern(3);
  KluFactors factors(pattern);
  std::vector<double> values(pattern.row.size(), 0.0);
  for (std::size_t column = 0; column < pattern.size(); ++column)
    for (auto k = static_cast<std::size_t>(pattern.column[column]);
         k < static_cast<std::size_t>(pattern.column[column + 1]); ++k)
      values[k] = pattern.row[k] == static_cast<std::int64_t>(column) ? 2.0 : 0.0;
  const std::vector<double> regular = values;
  const auto expect_solution = [&] {
    REQUIRE(factors.factor(regular.data()) == KluFactors::Outcome::done);
    std::vector<double> x(pattern.size(), 3.0);
    factors.solve(x.data());
    for (const double v : x) CHECK(v == 1.5);
  };
  expect_solution();
  for (auto k = static_cast<std::size_t>(pattern.column[4]); k < static_cast<std::size_t>(pattern.column[5]);
       ++k)
    values[k] = 0.0;
  CHECK(factors.factor(values.data()) == KluFactors::Outcome::singular);
  CHECK(factors.entries() == 0);
  expect_solution();
}
