// The ODE forms of the laws, integrated by the substepper and by CVODE, against closed forms and each other.
#include "catch.hpp"
#include "support/local_solvers.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

const std::vector<double> ladder{1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};

/// Calls measure(integrator) -> largest relative error for each solver and tolerance; asserts 100 x rtol, and
/// that the error falls over the ladder as far as rounding lets it.
template <class Measure>
void climb(Measure&& measure) {
  for (std::size_t k = 0; k < solvers(1.0).size(); ++k) {
    double first = 0.0, last = 0.0;
    for (const double rtol : ladder) {
      const LocalSolver solver = std::move(solvers(rtol)[k]);
      CAPTURE(solver.name, rtol);
      const double error = measure(*solver.integrator);
      CHECK(error <= 100.0 * rtol);
      if (rtol == ladder.front()) first = error;
      last = error;
    }
    CHECK(last <= std::max(1e-3 * first, 1e-11));
  }
}

double relative(double value, double exact) {
  return std::abs(value - exact) / std::abs(exact);
}

}  // namespace

TEST_CASE("damage at a constant rate: onset and localisation for every tolerance", "[local][verification]") {
  // Uniaxial strain, R = 1e3 /s: x_cr .118315, eps_1 1.471237e-4 R^(1/3) (physics of eqs. 4-9).
  const auto glass = composite_of(fracturing_glass(), cell);
  const double rate = 3.0e3, end = 1.6e-3;
  const double exact = 1.471237e-4 * 10.0;
  const Driven fine = drive(*glass, {{{end, 0, 0, 0}, end / rate}}, 1);
  REQUIRE(relative(fine.time_of(EventKind::localisation) * rate, exact) < 1e-6);
  // (The closed form integrates the dissipation of a whole increment by six Gauss points: good to 4e-6.)
  const Driven in_small_steps = drive(*glass, {{{end, 0, 0, 0}, end / rate}}, 2000);
  climb([&](LocalIntegrator& integrator) {
    const Driven d = drive(*glass, {{{end, 0, 0, 0}, end / rate}}, 1, {}, &integrator);
    REQUIRE(d.cause.empty());
    return std::max({relative(d.time_of(EventKind::localisation), fine.time_of(EventKind::localisation)),
                     relative(d.state.crack_density, fine.state.crack_density),
                     relative(d.state.stress.rr, fine.state.stress.rr),
                     relative(d.state.decohesion, fine.state.decohesion),
                     relative(d.dissipation.damage, in_small_steps.dissipation.damage)});
  });
}

TEST_CASE("decohesion in mode I: the traction falls linearly, for every tolerance", "[local][verification]") {
  const auto glass = composite_of(fracturing_glass(), cell);
  const double rate = 3.0e3;
  const Driven onset = drive(*glass, {{{1.6e-3, 0, 0, 0}, 1.6e-3 / rate}}, 1);
  const double start = onset.time_of(EventKind::localisation) * rate;
  const double tau0 = onset.state.cohesive_strength;
  const Moduli m = glass->secant_moduli(onset.state);
  const double slope = 1.0 / (5.0e-6 / cell - tau0 / m.p_wave());
  const double end = start + 0.7 / slope, separated = start + 1.0 / slope;
  climb([&](LocalIntegrator& integrator) {
    const Driven d = drive(*glass, {{{end, 0, 0, 0}, end / rate}}, 3, {}, &integrator);
    const Driven whole =
        drive(*glass, {{{1.2 * separated, 0, 0, 0}, 1.2 * separated / rate}}, 1, {}, &integrator);
    return std::max({relative(d.state.stress.rr, 0.3 * tau0),
                     relative(d.state.opening_n, d.state.decohesion * 5.0e-6),
                     relative(whole.time_of(EventKind::separation) * rate, separated),
                     relative(whole.dissipation.fracture, 0.5 * 5.0e-6 * tau0 / cell)});
  });
}

TEST_CASE("von Mises under a constant direction of the strain rate, for every tolerance",
          "[local][verification]") {
  Random random(20261124);
  for (const double hardening : {0.0, 9.6e9}) {
    MaterialParameters p = bare_steel();
    p.von_mises = VonMisesParameters{359.0e6, hardening > 0.0 ? 3590.0e6 : 359.0e6, hardening, 0.0};
    const auto steel = composite_of(p, cell);
    const double G = elastic_moduli(p.elastic).shear, radius = VonMisesLaw::factor * 359.0e6;
    const SymmetricTensor a = random.deviatoric_direction();
    SymmetricTensor b = random.deviatoric_direction();
    b = b - contract(a, b) * a;
    b = (1.0 / norm(b)) * b;
    // On the surface along a, then on along the direction psi0 from a.
    const double psi0 = 2.2, amount = 4.0e-3;
    const SymmetricTensor direction = std::cos(psi0) * a + std::sin(psi0) * b;
    CompositeState start;
    start.elastic_strain = (radius / (2.0 * G) * (1.0 - 1e-14)) * a;
    start.stress = elastic_moduli(p.elastic).stress(start.elastic_strain);
    // psi0 > 90 degrees: first elastic through the inside, back to the surface on the other side.
    const double chord = -2.0 * std::cos(psi0) * radius / (2.0 * G);
    const SymmetricTensor entry = start.elastic_strain + chord * direction;
    const double psi1 = std::acos(contract(entry, direction) / norm(entry));
    double psi = 0.0, size = radius;
    if (hardening == 0.0) {
      psi = 2.0 * std::atan(std::tan(0.5 * psi1) * std::exp(-2.0 * G * (amount - chord) / radius));
    } else {
      // d psi / d|e| = -2G sin(psi)/|s|, |s| = R0 (sin psi1 / sin psi)^kappa: by quadrature, psi from psi1
      // down.
      const double kappa = VonMisesLaw::factor * hardening / (2.0 * G + VonMisesLaw::factor * hardening);
      const int n = 20000;
      const double h = (amount - chord) / n;
      const auto rate = [&](double angle) {
        return -2.0 * G * std::sin(angle) / (radius * std::pow(std::sin(psi1) / std::sin(angle), kappa));
      };
      psi = psi1;
      for (int i = 0; i < n; ++i) {
        const double k1 = rate(psi), k2 = rate(psi + 0.5 * h * k1), k3 = rate(psi + 0.5 * h * k2),
                     k4 = rate(psi + h * k3);
        psi += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
      }
      size = radius * std::pow(std::sin(psi1) / std::sin(psi), kappa);
    }
    climb([&](LocalIntegrator& integrator) {
      const Driven d = drive(*steel, {{amount * direction, 1e-6}}, 1, start, &integrator);
      const SymmetricTensor s = deviator(d.state.stress);
      const double reached = std::acos(std::clamp(contract(s, direction) / norm(s), -1.0, 1.0));
      return std::max({std::abs(reached - psi), relative(norm(s), size),
                       relative(d.time_of(EventKind::yield), 1e-6 * chord / amount)});
    });
  }
}

TEST_CASE("substepper and CVODE agree on 1,008 random paths of every composition", "[local][verification]") {
  // Where softening flow and a softening plane compete, each may relieve the other by more than itself: such
  // a point has two continuations, and rounding decides. That may happen to a few paths of von Mises with
  // decohesion, to no other.
  Random random(31);
  int compared = 0, undecided = 0;
  for (int sample = 0; sample < 84; ++sample)
    for (const NamedMaterial& named : all_compositions()) {
      const auto material = composite_of(named.parameters, cell);
      const std::vector<Segment> path = path_with_reversals(random, random.logarithmic(3e-4, 3e-3), 1e4, 5);
      CAPTURE(named.name, sample);
      const std::vector<LocalSolver> tight = solvers(1e-8);
      const Driven a = drive(*material, path, 2, {}, tight[0].integrator.get());
      const Driven b = drive(*material, path, 2, {}, tight[1].integrator.get());
      const double scale = elastic_moduli(named.parameters.elastic).p_wave() * 1e-3;
      const double difference = a.cause.empty() && b.cause.empty()
                                    ? distance(a.state.stress, b.state.stress) / scale
                                    : std::numeric_limits<double>::infinity();
      ++compared;
      if (named.parameters.von_mises && named.parameters.decohesion && !(difference < 1e-5)) {
        ++undecided;
        continue;
      }
      CHECK(a.cause == "");
      CHECK(b.cause == "");
      CHECK(difference < 1e-5);
    }
  CHECK(compared == 1008);
  CHECK(undecided <= 5);
}

TEST_CASE("the closed form converges to the ODE form on random paths", "[local][verification]") {
  // Return mappings and implicit decohesion are of first order in the increment on paths that turn.
  Random random(47);
  int compared = 0, apart = 0;
  double coarse = 0.0, fine = 0.0;
  for (int sample = 0; sample < 20; ++sample)
    for (const NamedMaterial& named : all_compositions()) {
      const auto material = composite_of(named.parameters, cell);
      const std::vector<Segment> path = path_with_reversals(random, random.logarithmic(3e-4, 2e-3), 1e4, 4);
      CAPTURE(named.name, sample);
      const LocalSolver reference = std::move(solvers(1e-9)[1]);
      const Driven exact = drive(*material, path, 1, {}, reference.integrator.get());
      if (!exact.cause.empty()) continue;
      const double scale = elastic_moduli(named.parameters.elastic).p_wave() * 1e-3;
      const double error_100 = distance(drive(*material, path, 100).state.stress, exact.state.stress) / scale;
      const double error_1600 =
          distance(drive(*material, path, 1600).state.stress, exact.state.stress) / scale;
      ++compared;
      if (error_1600 > 1e-3) {
        ++apart;
        UNSCOPED_INFO(named.name << " sample " << sample << ": " << error_100 << " " << error_1600);
        continue;
      }
      coarse += error_100, fine += error_1600;
    }
  CHECK(compared >= 235);
  CHECK(apart <= compared / 50);
  CHECK(fine <= coarse / 8.0);
}

TEST_CASE("viscous decohesion: stiff relaxation, down to viscosities of 1e-15 s", "[local][verification]") {
  // eta -> 0 with a well-posed softening is the rate-independent law.
  const double rate = 3.0e3, end = 4.0e-3;
  const auto inviscid = composite_of(fracturing_glass(), cell);
  const Driven limit = drive(*inviscid, {{{end, 0, 0, 0}, end / rate}}, 1);
  for (const double viscosity : {1e-9, 1e-12, 1e-15}) {
    MaterialParameters p = fracturing_glass();
    p.decohesion->viscosity = viscosity;
    const auto glass = composite_of(p, cell);
    const Driven fine = drive(*glass, {{{end, 0, 0, 0}, end / rate}}, 20000);
    for (const LocalSolver& solver : solvers(1e-6)) {
      CAPTURE(solver.name, viscosity);
      const Driven d = drive(*glass, {{{end, 0, 0, 0}, end / rate}}, 1, {}, solver.integrator.get());
      REQUIRE(d.cause == "");
      CHECK(relative(d.state.decohesion, fine.state.decohesion) < 1e-4);
      CHECK(std::abs(d.state.decohesion - limit.state.decohesion) < 10.0 * viscosity * rate / 1e-4 + 1e-5);
      CHECK(d.solver.steps < 5000);
    }
  }
}

TEST_CASE("Drucker-Prager under proportional shear with growing pressure, for every tolerance",
          "[local][verification]") {
  MaterialParameters p = bare_glass();
  p.drucker_prager = glass_drucker_prager();
  const auto glass = composite_of(p, cell);
  const Moduli m = elastic_moduli(p.elastic);
  const SymmetricTensor n = Random(8).deviatoric_direction();
  const double shear = 4.0e-3, volume = -3.0e-4;
  const double pressure = -m.bulk * 3.0 * volume, q = 43.0e6 + 1.8 * pressure;
  const double elastic = q / (2.0 * m.shear * std::sqrt(1.5));
  // f = 0 where 2G sqrt(3/2) shear s = sigma_y + beta P s.
  const double yields = 43.0e6 / (2.0 * m.shear * std::sqrt(1.5) * shear - 1.8 * pressure);
  climb([&](LocalIntegrator& integrator) {
    const Driven d = drive(*glass, {{shear * n + volume * identity(), 1e-6}}, 1, {}, &integrator);
    return std::max({relative(norm(deviator(d.state.elastic_strain)), elastic),
                     relative(d.state.plastic_strain, shear - elastic),
                     relative(d.time_of(EventKind::yield), 1e-6 * yields)});
  });
}

TEST_CASE("on random paths with reversals the error stays within 100 rtol over the whole ladder",
          "[local][verification]") {
  // Against CVODE at 1e-12. Stresses relative to the largest of the path, times to the duration of the path.
  std::vector<NamedMaterial> materials{{"damage", damaging_glass()}, {"decohesion", fracturing_glass()}};
  materials.push_back({"von Mises", flowing_steel()});
  materials.push_back({"Drucker-Prager", bare_glass()});
  materials.back().parameters.drucker_prager = glass_drucker_prager();
  Random random(77);
  for (const NamedMaterial& named : materials) {
    const auto material = composite_of(named.parameters, cell);
    for (int sample = 0; sample < 6; ++sample) {
      const std::vector<Segment> path = path_with_reversals(random, 2e-3, 1e4, 5);
      CAPTURE(named.name, sample);
      double duration = 0.0;
      for (const Segment& segment : path) duration += segment.duration;
      Cvode tight({1e-12, 1e-15}, CvodeFamily::bdf);
      const Driven exact = drive(*material, path, 1, {}, &tight);
      REQUIRE(exact.cause == "");
      const double scale = elastic_moduli(named.parameters.elastic).p_wave() * 2e-3;
      for (std::size_t k = 0; k < 2; ++k)
        for (const double rtol : ladder) {
          const LocalSolver solver = std::move(solvers(rtol)[k]);
          CAPTURE(solver.name, rtol);
          const Driven d = drive(*material, path, 1, {}, solver.integrator.get());
          REQUIRE(d.cause == "");
          CHECK(distance(d.state.stress, exact.state.stress) <= 100.0 * rtol * scale);
          CHECK(d.events.size() == exact.events.size());
          for (std::size_t i = 0; i < std::min(d.events.size(), exact.events.size()); ++i)
            CHECK(std::abs(d.events[i].time - exact.events[i].time) <= 100.0 * rtol * duration);
        }
    }
  }
}
