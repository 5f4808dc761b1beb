#pragma once
#include <string>

#include "support/mpm_run.hpp"

namespace vitrum::test {

/// An integrator with its default settings.
struct Integrator {
  std::string name;  ///< a scheme of explicit steps, or a method

  void choose(MpmScene& scene) const {
    const bool steps = name.find("arkode") == std::string::npos;
    scene.method = steps ? "explicit" : name;
    if (steps) scene.scheme = name;
    scene.pace = "";
  }
};
inline const Integrator five_integrators[] = {
    {"usf"}, {"usl"}, {"musl"}, {"arkode-explicit"}, {"arkode-implicit"}};

/// Two bars of 25 mm: glass without Poisson's effect, c = 5000 m/s, in cells of 0.5 mm with four particles
/// each, at default settings. contact: lines of [contact].
inline MpmScene bars(double gap, double va, double vb, const std::string& contact = "") {
  MpmScene scene;
  scene.shape = "gimp", scene.cell = 0.5e-3, scene.scheme = "musl", scene.pace = "";
  scene.density = 2500.0, scene.young = 62.5e9, scene.poisson = 0.0;
  const auto moving = [](double v) { return "particles_per_cell = 4\nvelocity = " + pair({v, 0.0}); };
  scene.tables = "[contact]\nmethod = \"bodies\"\n" + contact +
                 body("a", box({-0.025, 0.0}, {0.0, 0.001}), moving(va)) +
                 body("b", box({gap, 0.0}, {0.025 + gap, 0.001}), moving(vb));
  return scene;
}

inline double mean_velocity(MpmRun& run, std::size_t body, std::size_t component = 0) {
  return mass_mean(run.particles(body), run.particles(body).velocity[component]);
}

}  // namespace vitrum::test
