#include "integrators/grid/grid_system.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "catch.hpp"
#include "integrators/grid/error_scales.hpp"
#include "integrators/sundials/reduced_solver.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"
#include "vitrum_source_dir.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// Two elastic bodies in contact with particles anywhere, a held wall and an initial stress.
MpmScene scene_of(const std::string& geometry, const std::string& shape) {
  MpmScene scene;
  scene.geometry = geometry, scene.shape = shape;
  scene.tables = body("block", box({0.0, 0.0}, {4.0, 3.0}),
                      "particles_per_cell = 4\nstress = [0.001, -0.002, 0.0015, 0.0005]") +
                 body("ball", disk({2.0, 5.2}, 1.4), "velocity = [0.0, -0.01]") +
                 hold("[-inf, -inf]", "[inf, 0]", geometry == "axisymmetric" ? "\"r\", \"z\"" : "\"y\"");
  return scene;
}

void scatter_at_random(System& system, Random& random, double by) {
  for (Body& b : system.bodies)
    for (auto& column : b.particles.position)
      for (double& x : column) x = std::abs(x + random.uniform(-by, by));
  system.grid_is_stale = true;
}

std::vector<double> rates_at(GridSystem& grid, double t, const std::vector<double>& y) {
  std::vector<double> f(y.size());
  REQUIRE(grid.rates(t, y.data(), f.data()));
  return f;
}

/// How far K x is from the difference of forces between two states that are `apart` x from each other,
/// relative to it.
double distance_from_differences(GridSystem& grid, const std::vector<double>& Kx,
                                 const std::vector<double>& f_plus, const std::vector<double>& f_minus,
                                 double apart) {
  std::vector<double> mass(grid.pattern().row.size());
  grid.form(0.0, mass.data());
  const std::size_t n = Kx.size();
  double error = 0.0, norm = 0.0;
  for (std::size_t column = 0; column < n; ++column)
    for (auto e = static_cast<std::size_t>(grid.pattern().column[column]);
         e < static_cast<std::size_t>(grid.pattern().column[column + 1]); ++e) {
      if (grid.pattern().row[e] != static_cast<std::int64_t>(column)) continue;
      const double force = mass[e] * (f_plus[n + column] - f_minus[n + column]) / apart;
      error += std::pow(force - Kx[column], 2), norm += force * force;
    }
  return std::sqrt(error / norm);
}

}  // namespace

TEST_CASE("The reduced Newton equations solve those of the whole system", "[integrators][mpm]") {
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* shape : {"linear", "gimp", "bspline2"}) {
      CAPTURE(geometry, shape);
      Random random(11);
      MpmRun run(scene_of(geometry, shape));
      scatter_at_random(run.system, random, 0.3);
      GridSystem grid(run.system, {1.0, 1e-3, 1.0}, 1e-3);
      grid.begin_phase();
      const std::size_t size = grid.size(), n = size / 2;
      std::vector<double> y(size + grid.integrals());
      grid.start(y.data());
      for (std::size_t k = 0; k < n; ++k) y[k] = random.uniform(-1e-5, 1e-5);
      REQUIRE(grid.linearise(0.1, y.data()));
      // A x with the Jacobian of the rates by central differences, for random x.
      std::vector<double> x(size), y_plus = y, y_minus = y;
      for (double& v : x) v = random.uniform(-1.0, 1.0);
      constexpr double gamma = 0.3, h = 1e-6;
      for (std::size_t k = 0; k < size; ++k) y_plus[k] += h * x[k], y_minus[k] -= h * x[k];
      const auto f_plus = rates_at(grid, 0.1, y_plus), f_minus = rates_at(grid, 0.1, y_minus);
      std::vector<double> b(size);
      for (std::size_t k = 0; k < size; ++k) b[k] = x[k] - gamma * (f_plus[k] - f_minus[k]) / (2.0 * h);
      const auto& pattern = grid.pattern();
      std::vector<double> values(pattern.row.size());
      grid.form(gamma, values.data());
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
      for (std::size_t column = 0; column < n; ++column)
        for (auto e = pattern.column[column]; e < pattern.column[column + 1]; ++e)
          A(pattern.row[static_cast<std::size_t>(e)], static_cast<Eigen::Index>(column)) +=
              values[static_cast<std::size_t>(e)];
      Eigen::VectorXd c(static_cast<Eigen::Index>(n));
      grid.reduce(gamma, b.data(), c.data());
      const Eigen::VectorXd z = A.fullPivLu().solve(c);
      std::vector<double> found(size);
      grid.expand(gamma, b.data(), z.data(), found.data());
      // Geometric stiffness and the volume's change are left out of K: relative to the rest they are strains.
      double error = 0.0, norm = 0.0;
      for (std::size_t k = 0; k < size; ++k) error += std::pow(found[k] - x[k], 2), norm += x[k] * x[k];
      CAPTURE(std::sqrt(error / norm));
      CHECK(std::sqrt(error / norm) < 0.05);
    }
}

TEST_CASE("Without stress the stiffness is the derivative of the forces", "[integrators][mpm]") {
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* shape : {"linear", "gimp", "bspline2"})
      for (const bool pressed : {false, true}) {  // by a pressure that follows
        CAPTURE(geometry, shape, pressed);
        Random random(17);
        MpmScene scene = scene_of(geometry, shape);
        scene.tables.replace(scene.tables.find("stress = "),
                             std::string("stress = [0.001, -0.002, 0.0015, 0.0005]").size(), "");
        if (pressed)
          scene.tables +=
              "[[traction]]\nbody = \"block\"\nbox = {min = [0.5, 0], max = [inf, inf]}\npressure = 0.05\n"
              "follows = true\n";
        MpmRun run(scene);
        scatter_at_random(run.system, random, 0.3);
        GridSystem grid(run.system, {1.0, 1e-3, 1.0}, 1e-3);
        grid.begin_phase();
        const std::size_t n = grid.size() / 2;
        std::vector<double> y(grid.size() + grid.integrals()), x(n);
        grid.start(y.data());
        REQUIRE(grid.linearise(0.0, y.data()));
        // form(1) - form(0) is K, reduce with b = (x, 0) gives -K x.
        std::vector<double> b(grid.size(), 0.0), Kx(n);
        for (std::size_t k = 0; k < n; ++k) b[k] = x[k] = random.uniform(-1.0, 1.0);
        grid.reduce(1.0, b.data(), Kx.data());
        constexpr double h = 1e-7;
        auto y_plus = y, y_minus = y;
        for (std::size_t k = 0; k < n; ++k) y_plus[k] += h * x[k], y_minus[k] -= h * x[k];
        const auto f_plus = rates_at(grid, 0.1, y_plus), f_minus = rates_at(grid, 0.1, y_minus);
        CHECK(distance_from_differences(grid, Kx, f_plus, f_minus, 2.0 * h) < 1e-7);
      }
}

TEST_CASE("The stiffness of contact is the derivative of its forces: pressed, sticking, sliding",
          "[integrators][contact]") {
  for (const char* friction : {"0", "0.3", "inf"})
    for (const double drawn : {0.0, 1.0}) {
      CAPTURE(friction, drawn);
      MpmScene scene;
      scene.shape = "gimp";
      scene.tables = fmt::format("[contact]\nmethod = \"bodies\"\nfriction = {}\n", friction) +
                     body("low", box({0.0, 0.0}, {6.0, 2.0}), "particles_per_cell = 4") +
                     body("high", box({1.0, 2.0}, {5.0, 4.0}),
                          "particles_per_cell = 4\nvelocity = " + pair({drawn, -0.5}));
      MpmRun run(scene);
      GridSystem grid(run.system, {1.0, 1e-3, 1.0}, 1e-3);
      grid.begin_phase();
      const std::size_t n = (grid.size() - mpm::Contact::rates_of_pair) / 2;
      std::vector<double> y(grid.size() + grid.integrals()), x(n), Kx(n), b(grid.size(), 0.0);
      grid.start(y.data());
      // Springs know from where on they stretch once they have been pressed together.
      for (std::size_t k = 0; k < n; ++k) y[k] = 0.01 * y[n + k];
      grid.commit(0.05, y.data());
      for (std::size_t k = 0; k < n; ++k) y[k] *= 2.0;
      REQUIRE(grid.linearise(0.1, y.data()));
      Random random(23);
      for (std::size_t k = 0; k < n; ++k) b[k] = x[k] = random.uniform(-1.0, 1.0);
      grid.reduce(1.0, b.data(), Kx.data());
      constexpr double h = 1e-7;
      auto plus = y, minus = y;
      for (std::size_t k = 0; k < n; ++k) plus[k] += h * x[k], minus[k] -= h * x[k];
      const auto f_plus = rates_at(grid, 0.1, plus), f_minus = rates_at(grid, 0.1, minus);
      CHECK(f_plus[2 * n + 1] < 0.0);  // they are pressed together
      // Arms from the nodes' particles to the surface, and what turns them, are left out of K.
      CHECK(distance_from_differences(grid, Kx, f_plus, f_minus, 2.0 * h) < 0.08);
    }
}

TEST_CASE("Right-hand sides leave the committed state alone, to the bit", "[integrators][mpm]") {
  const Scene scene = read_scene(std::string(VITRUM_SOURCE_DIR) + "/studies/paper/reference.toml",
                                 {"body.0.box.max=[0.02, 0.005]"});
  MpmRun run(scene);
  run.advance(-1.6e-6);  // steel yields, glass is about to damage
  GridSystem grid(run.system, {200.0, 1e-3, 1e-3}, 1e-3);
  grid.begin_phase();  // which may move particles in memory
  const auto before = run.system.bodies;
  std::vector<double> y(grid.size() + grid.integrals());
  grid.start(y.data());
  for (std::size_t k = 0; k < grid.size() / 2; ++k) y[k] = 1e-7 * y[grid.size() / 2 + k];
  for (int k = 0; k < 3; ++k) {
    rates_at(grid, run.system.time + 1e-7, y);
    REQUIRE(grid.linearise(run.system.time + 1e-7, y.data()));
  }
  for (std::size_t n = 0; n < before.size(); ++n) {
    const Particles &a = before[n].particles, &b = run.system.bodies[n].particles;
    CHECK(a.position == b.position);
    CHECK(a.velocity == b.velocity);
    CHECK(a.elastic_strain == b.elastic_strain);
    CHECK(a.variables == b.variables);
    CHECK(b.tried_stress[0].empty());
  }
}

TEST_CASE("The factors of a wide body have the entries of minimum degree on a symmetric pattern",
          "[integrators]") {
  // 64 x 64 cells: minimum degree leaves 159 entries a row and factor. Rows exchanged before ordering
  // (KLU's search for a block-triangular form) make it several times as many.
  MpmScene scene;
  scene.geometry = "plane-strain";
  scene.tables =
      body("block", box({0.0, 0.0}, {64.0, 64.0}), "particles_per_cell = 1\nvelocity = [0.0, -0.01]");
  MpmRun run(scene);
  GridSystem grid(run.system, error_scales(run.system, {}), 1e-3);
  grid.begin_phase();
  std::vector<double> y(grid.size() + grid.integrals());
  grid.start(y.data());
  const vitrum::sundials::Context context;
  vitrum::sundials::ReducedSolver solver(context, grid, vitrum::sundials::ReducedSolver::Kind::factor);
  CHECK(solver.factor_entries() == 0);
  REQUIRE(solver.form(1e-6, y.data(), 1.0, false) == 0);
  REQUIRE(solver.factor() == 0);
  const auto rows = static_cast<double>(grid.pattern().size());
  CAPTURE(rows);
  CHECK(static_cast<double>(solver.factor_entries()) < 2.0 * 250.0 * rows);
  CHECK(static_cast<double>(solver.factor_entries()) > 2.0 * 60.0 * rows);
}

TEST_CASE("What a grid system computes is the same for any number of threads",
          "[integrators][mpm][threads]") {
  for (const char* geometry : {"axisymmetric", "plane-strain"}) {
    std::vector<std::vector<double>> found;
    for (const int threads : {1, 2, 3}) {
      MpmScene scene = scene_of(geometry, "linear");
      scene.tables += body("large", box({0.0, 8.0}, {14.0, 24.0}), "particles_per_cell = 4");
      MpmRun run(scene, threads);
      Random random(13);
      scatter_at_random(run.system, random, 0.3);
      GridSystem grid(run.system, {1.0, 1e-3, 1.0}, 1e-3);
      grid.begin_phase();
      std::vector<double> y(grid.size() + grid.integrals()), matrix(grid.pattern().row.size()), all;
      grid.start(y.data());
      // Once as committed, once deformed, once deformed further after a commit.
      for (const double time : {0.1, 0.2, 0.3}) {
        const std::vector<double> f = rates_at(grid, time, y);
        REQUIRE(grid.linearise(time, y.data()));
        grid.form(0.3, matrix.data());
        grid.commit(time, y.data());
        all.insert(all.end(), f.begin(), f.end());
        all.insert(all.end(), matrix.begin(), matrix.end());
        all.insert(all.end(), {run.system.record.kinetic, run.system.record.elastic, grid.deformation()});
        for (std::size_t k = 0; k < grid.size() / 2; ++k) y[k] += random.uniform(-1e-3, 1e-3);
      }
      found.push_back(all);
    }
    for (const std::vector<double>& of_threads : found) CHECK(of_threads == found.front());
  }
}
