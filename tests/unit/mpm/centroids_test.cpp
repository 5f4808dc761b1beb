#include <cmath>

#include "catch.hpp"
#include "mpm/between_centroids.hpp"
#include "mpm/centroids.hpp"
#include "mpm/stress.hpp"
#include "mpm/transfer.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::mpm;
using namespace vitrum::test;

namespace {

using Matrix = BetweenCentroids::Matrix;

Matrix random_matrix(Random& random) {
  Matrix m{};
  for (double& x : m) x = random.uniform(-1.0, 1.0);
  return m;
}
Matrix product(const Matrix& a, const Matrix& b) {
  return {a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2],
          a[2] * b[1] + a[3] * b[3]};
}
double inner(const Matrix& a, const Matrix& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// Clouds of particles somewhere on the grid, at some angle: a body, one that is disordered, a row, a pair,
/// debris.
constexpr const char* clouds[] = {"body", "disordered", "row", "pair", "debris"};

MpmRun cloud_of(const std::string& cloud, const char* shape, Random& random) {
  const int per_cell = random.chance(0.5) ? 1 : 4;
  MpmScene scene;
  scene.shape = shape, scene.gradients = "centroids";
  const auto more = fmt::format("particles_per_cell = {}", per_cell);
  if (cloud == "row")
    scene.tables = body("row", box({-6.0, 0.0}, {6.0, 1.0}), "particles_per_cell = 1");
  else if (cloud == "pair")
    scene.tables = body("pair", box({0.0, 0.0}, {2.0, 1.0}), "particles_per_cell = 1");
  else
    scene.tables = body("disk", disk({0.0, 0.0}, 4.7), more);
  MpmRun run(scene);
  Particles& p = run.particles();
  const Rotation turn = rotation_by(random.uniform(0.0, 6.0));
  const double x = random.uniform(-50.0, 50.0), y = random.uniform(-50.0, 50.0),
               spread = cloud == "pair" ? random.uniform(0.1, 2.0) : 1.0;
  for (std::size_t i = 0; i < p.size; ++i) {
    double r = p.position[0][i], z = p.position[1][i];
    if (cloud == "disordered") r += random.uniform(-0.4, 0.4), z += random.uniform(-0.4, 0.4);
    if (cloud == "debris") r = random.uniform(-6.0, 6.0), z = random.uniform(-6.0, 6.0);
    p.position[0][i] = x + spread * (turn.cosine * r - turn.sine * z);
    p.position[1][i] = y + spread * (turn.sine * r + turn.cosine * z);
  }
  run.system.grid_is_stale = true;
  return run;
}

template <class F>
void for_clouds(F&& f) {
  Random random(5);
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const char* cloud : clouds)
      for (int n = 0; n < 10; ++n) {
        CAPTURE(shape, cloud, n);
        MpmRun run = cloud_of(cloud, shape, random);
        refresh_grid(run.system);
        find_centroids(run.system);
        f(run, random);
      }
}

}  // namespace

TEST_CASE("Between centroids that lie as nodes do a gradient stays what it is; a turn is a turn anyhow",
          "[mpm]") {
  Random random(3);
  for (int n = 0; n < 1000; ++n) {
    const Matrix g = random_matrix(random), H = random_matrix(random), turn{0.0, -0.7, 0.7, 0.0};
    const Matrix same = BetweenCentroids({1.0, 0.0, 0.0, 1.0}).gradient(g),
                 turned = BetweenCentroids(H).gradient(product(turn, H));
    const double determinant = std::abs(H[0] * H[3] - H[1] * H[2]);
    for (std::size_t k = 0; k < 4; ++k) {
      REQUIRE(std::abs(same[k] - g[k]) < 1e-11);
      REQUIRE(std::abs(turned[k] - turn[k]) < 1e-10 / std::min(1.0, determinant * determinant));
    }
  }
}

TEST_CASE("The stress that forces are made of has the power of the law's on the gradient between centroids",
          "[mpm]") {
  Random random(4);
  for (int n = 0; n < 1000; ++n) {
    const BetweenCentroids at(random_matrix(random));
    const Matrix g = random_matrix(random), stress = random_matrix(random);
    const double power = inner(stress, at.gradient(g));
    REQUIRE(inner(at.stress(stress), g) == Approx(power).margin(1e-9));
  }
}

TEST_CASE("Any cloud that moves and turns as a rigid one is not strained, and turns at its own rate",
          "[mpm]") {
  for_clouds([](MpmRun& run, Random& random) {
    System& s = run.system;
    Particles& p = run.particles();
    const double u = random.uniform(-1.0, 1.0), v = random.uniform(-1.0, 1.0),
                 rate = random.uniform(-1.0, 1.0);
    for (std::size_t i = 0; i < p.size; ++i)
      p.velocity[0][i] = u - rate * p.position[1][i], p.velocity[1][i] = v + rate * p.position[0][i];
    scatter(s, Scatter::momentum);
    project_velocities(s);
    gather(s, Gather::strain, 1e-3);
    double worst = 0.0;
    for (std::size_t i = 0; i < p.size; ++i)
      for (const auto& e : p.strain_increment) worst = std::max(worst, std::abs(e[i]));
    CHECK(worst < 1e-12);  // of 1e-3
  });
}

TEST_CASE("Internal forces have no moment: particles between centroids keep their angular momentum",
          "[mpm]") {
  for_clouds([](MpmRun& run, Random& random) {
    System& s = run.system;
    Particles& p = run.particles();
    for (auto& e : p.elastic_strain)
      for (double& value : e) value = random.uniform(-0.01, 0.01);
    scatter(s, Scatter::momentum_and_force, Nodes::sums);
    project_velocities(s);
    accelerate(s);
    std::vector<double> columns[10];
    for (auto& column : columns) column.assign(p.size, 0.0);
    const ParticleRates rates[]{{{columns[0].data(), columns[1].data()},
                                 {columns[2].data(), columns[3].data()},
                                 {columns[4].data(), columns[5].data(), columns[6].data(), columns[7].data()},
                                 columns[8].data(),
                                 columns[9].data()}};
    gather_rates(s, rates);
    double x = 0.0, y = 0.0, mass = 0.0, moment = 0.0, scale = 0.0;
    for (std::size_t i = 0; i < p.size; ++i)
      mass += p.mass[i], x += p.mass[i] * p.position[0][i], y += p.mass[i] * p.position[1][i];
    for (std::size_t i = 0; i < p.size; ++i) {
      const double along = (p.position[0][i] - x / mass) * columns[3][i],
                   across = (p.position[1][i] - y / mass) * columns[2][i];
      moment += p.mass[i] * (along - across), scale += p.mass[i] * (std::abs(along) + std::abs(across));
    }
    CHECK(std::abs(moment) < 1e-9 * scale + 1e-12);  // (a pair may share no node: rounding)
  });
}
