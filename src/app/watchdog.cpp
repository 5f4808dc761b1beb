#include "app/watchdog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrum::app {

std::optional<std::string> Watchdog::look(const System& system, const EnergyLedger& ledger,
                                          double step) const {
  const EnergyTotals& e = ledger.totals();
  if (!std::isfinite(e.kinetic + e.elastic + e.external + e.plastic + e.damage + e.fracture + e.contact +
                     e.friction + e.filtered + e.removed))
    return describe(system, "the energy is not finite") + "; " + integrator_.advice(system, step);
  const double growth = ledger.growth(integrator_.tolerated_energy(system));
  if (growth <= max_growth_) return std::nullopt;
  return describe(system,
                  fmt::format("kinetic + elastic energy has grown to {:.4g} times the energy put in (bound: "
                              "integrator.max_growth "
                              "= {:g})",
                              growth, max_growth_)) +
         "; " + integrator_.advice(system, step) + " (integrator.max_growth = inf runs on regardless)";
}

std::string Watchdog::describe(const System& system, const std::string& cause) {
  std::string text = fmt::format("t = {:.6e} s, step {}: {}", system.time, system.step_index, cause);
  const Body* fastest = nullptr;
  std::size_t particle = 0;
  double speed = -1.0;
  for (const Body& body : system.bodies)
    for (std::size_t i = 0; i < body.particles.size; ++i) {
      const double v = std::hypot(body.particles.velocity[0][i], body.particles.velocity[1][i]);
      if (v > speed || std::isnan(v)) speed = v, fastest = &body, particle = i;
      if (std::isnan(v)) break;
    }
  if (fastest != nullptr)
    text +=
        fmt::format("; fastest: body '{}', particle {} at ({:.6g}, {:.6g}) m with {:.4g} m/s", fastest->name,
                    fastest->particles.identity[particle], fastest->particles.position[0][particle],
                    fastest->particles.position[1][particle], speed);
  return text;
}

}  // namespace vitrum::app
