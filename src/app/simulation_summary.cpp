#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/command_line.hpp"
#include "app/messages.hpp"
#include "app/plausibility.hpp"
#include "app/simulation.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/domain.hpp"
#include "mpm/filter.hpp"
#include "mpm/removal.hpp"
#include "mpm/stress.hpp"
#include "observe/bodies.hpp"
#include "scene/choices.hpp"
#include "scene/input_error.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::app {
namespace {

bool finite_state(const System& system) {
  for (const Body& body : system.bodies) {
    const Particles& p = body.particles;
    const auto stress = mpm::stress_of(body);
    for (std::size_t i = 0; i < p.size; ++i) {
      const double sum = p.position[0][i] + p.position[1][i] + p.velocity[0][i] + p.velocity[1][i] +
                         stress[0][i] + stress[1][i] + stress[2][i] + stress[3][i];
      if (!std::isfinite(sum)) return false;
    }
  }
  return true;
}

std::string place(const std::optional<FirstEvent>& e) {
  return e ? fmt::format("{:.3f} us at ({:.2f}, {:.2f}) mm", 1e6 * e->time, 1e3 * e->r, 1e3 * e->z) : "none";
}

/// The account as seen from the common centre of mass, where nothing but the bodies acts on each other: no
/// force can take the rest of their energy, which is larger or smaller by the frame of reference only. Where
/// bodies drift so fast that less than a hundredth is left, the account as it is: the rounding of the drift
/// and the crossing of cells would be all that is judged.
EnergyTotals seen_from_centre(const System& system, EnergyTotals account, double whole) {
  if (!system.grid.boundaries().empty() || account.largest_work > 0.0 || account.removed > 0.0)
    return account;
  double mass = 0.0;
  std::array<double, 2> momentum{};
  for (const Body& body : system.bodies)
    for (std::size_t i = 0; i < body.particles.size; ++i) {
      mass += body.particles.mass[i];
      for (std::size_t c = system.axisymmetric ? 1 : 0; c < 2; ++c)
        momentum[c] += body.particles.mass[i] * body.particles.velocity[c][i];
    }
  const double speed = std::hypot(momentum[0], momentum[1]) / mass,
               common = whole * 0.5 * mass * speed * speed;
  if (!(account.initial - common > 0.01 * account.initial)) return account;
  account.initial -= common, account.kinetic -= common;
  return account;
}

}  // namespace

int Simulation::finish(output::RunStatus status, std::string message, int exit_status) {
  if (status == output::RunStatus::failed) {
    try {
      // What a failed run computed last is a result, as long as it is numbers.
      if (finite_state(system_)) write_output();
      observers_.tell_last(system_);
      tables_.write_all();
    } catch (const FileError& error) {
      message += fmt::format("; its last state could not be written: {}", error.what());
    }
  } else if (status == output::RunStatus::complete) {
    observers_.tell_last(system_);  // not if interrupted: a resumed run goes on with the rows it has
    tables_.write_all();
  }
  return conclude(status, message, exit_status);
}

int Simulation::conclude(output::RunStatus status, const std::string& message, int exit_status) {
  progress_.finish();
  output::RunSummary s = summary(status, message);
  Warnings found;
  if (status == output::RunStatus::complete) found = closing_warnings(s);
  s.warnings.insert(s.warnings.end(), found.begin(), found.end());
  try {
    require_folder();
    tables_.store();
    result_->settle();
    output::write_summary(directory_ / "summary.json", s);
  } catch (const FileError& error) {
    if (status == output::RunStatus::complete) return give_up(error.what());
    complain(error.what());
  }
  try {
    if (!options_.quiet) show(summary_text(s));
  } catch (const FileError& error) {  // the results are in their files all the same
    complain(error.what());
    if (exit_status == exit_done) exit_status = exit_file;
  }
  for (const std::string& w : found) warn(w);
  if (status == output::RunStatus::failed) complain(message);
  if (status == output::RunStatus::interrupted) tell_interrupted(message);
  return exit_status;
}

/// What only the end of a run tells: an account that does not close, a tolerance that did not act.
Warnings Simulation::closing_warnings(const output::RunSummary& s) const {
  Warnings list;
  const double tolerated = whole_ * integrator_->tolerated_energy(system_);
  const EnergyTotals seen = seen_from_centre(system_, s.energy, whole_);
  const double residual = seen.relative_residual();
  if (judge(s.energy, tolerated) == EnergyAccount::meaningless)
    list.push_back(fmt::format("the energy account has no meaning (residual {:.3g} %): the run has blown up",
                               100.0 * s.energy.relative_residual()));
  else if (judge(seen, tolerated) != EnergyAccount::closes)
    list.push_back(fmt::format(
        "the numerics {} {:.1f} % of the energy{}: the steps do not resolve this run; {}",
        residual < 0.0 ? "made" : "lost", 100.0 * std::abs(residual),
        seen.initial < s.energy.initial ? " that bodies have about their common centre of mass" : "",
        residual < 0.0
            ? integrator_->advice(system_, state_.last_step)
            : integrator_->advice_on_loss(system_, state_.last_step, s.energy.residual() / whole_)));
  if (system_.contact) warn_of_depth(system_, list);
  // (With one particle a cell what is left of waves is no larger.)
  constexpr double much = 0.05;
  if (s.ringing > much * s.energy.scale() &&
      std::ranges::any_of(scene_.bodies, [](const BodyDefinition& b) { return b.particles_per_cell > 1; }))
    list.push_back(
        fmt::format("{}: neighbouring particles hold {:.1f} % of the energy against each other in pressures "
                    "that nodes do "
                    "not see; try space.filter = \"pressures\" or one particle a cell",
                    scene_.at("body"), 100.0 * s.ringing / s.energy.scale()));
  if (const std::size_t count = mpm::overstretched(system_); count > 0)
    list.push_back(
        fmt::format("{}: {} particles have been stretched to more than two cells, which is as far "
                    "as shape functions follow them; try larger cells or more particles a cell",
                    scene_.at("space.shape_functions"), count));
  if (const auto idle = idle_tolerance(scene_, s.integrator)) list.push_back(scene::single_line(*idle));
  return list;
}

output::RunSummary Simulation::summary(output::RunStatus status, const std::string& message) const {
  output::RunSummary s;
  s.status = status;
  s.message = message;
  s.warnings = warned_;
  s.time = system_.time;
  s.particles = system_.particle_count();
  s.wall_seconds = state_.wall_seconds;
  s.total_seconds = total_seconds();
  s.threads = system_.team->size();
  s.integrator_method = name_of(scene_.integrator.method);
  s.constitutive_method = name_of(scene_.constitutive.method);
  const IntegratorState& integration = integrator_->state();
  s.integrator = integration.counters;
  if (integrator_->estimates_errors()) s.error = integration.error;
  s.phases = integration.phases;
  s.remap_loss = whole_ * integration.remap_loss;
  s.constitutive.evaluations = system_.constitutive_evaluations;
  s.constitutive.events = system_.constitutive_events;
  s.constitutive.solver = system_.constitutive_solver;
  s.energy = shown_energy();
  s.ringing = finite_state(system_) ? whole_ * mpm::ringing_energy(system_)
                                    : std::numeric_limits<double>::quiet_NaN();
  s.failure = failure_.report(system_, finite_state(system_));
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    const Body& body = system_.bodies[n];
    s.bodies.push_back({body.name, body.particles.size, motion_of(body, whole_), s.failure.bodies[n]});
    if (mpm::removes(body)) s.bodies.back().removed = {body.removed, whole_ * mpm::removed_mass(body)};
  }
  if (system_.contact)
    for (std::size_t n = 0; n < system_.contact->pairs().size(); ++n) {
      const mpm::BodyPair& pair = system_.contact->pairs()[n];
      const mpm::ContactHistory& history = system_.contact->history()[n];
      s.contacts.push_back({{system_.bodies[pair.a].name, system_.bodies[pair.b].name},
                            {whole_ * history.impulse[0], whole_ * history.impulse[1]},
                            whole_ * history.friction_work,
                            history.least_gap});
    }
  s.provenance = provenance_;
  return s;
}

std::string Simulation::summary_text(const output::RunSummary& s) const {
  const EnergyTotals& e = s.energy;
  const char* unit = system_.axisymmetric ? "J" : "J/m";
  const double rate =
      s.wall_seconds > 0.0 ? static_cast<double>(s.constitutive.evaluations) / s.wall_seconds : 0.0;
  std::string text = fmt::format(
      "{}: {} particles, {} steps to t = {:.4g} us in {:.2f} s ({:.3g} particle-steps/s, {} thread{})\n",
      scene::single_line(scene_.title), s.particles, s.integrator.steps, 1e6 * s.time, s.wall_seconds, rate,
      s.threads, s.threads == 1 ? "" : "s");
  text += fmt::format(
      "energy ({}): initial {:.5g}, kinetic {:.5g}, elastic {:.5g}, plastic {:.5g}, damage {:.5g}, fracture "
      "{:.5g}, external "
      "{:.5g}\n",
      unit, e.initial, e.kinetic, e.elastic, e.plastic, e.damage, e.fracture, e.external);
  if (system_.contact)
    text += fmt::format("contact ({}): stored {:.5g}, friction {:.5g}\n", unit, e.contact, e.friction);
  text += fmt::format("energy residual {:+.5g} {} ({:+.3f} %), largest growth {:.4f}\n", e.residual(), unit,
                      100.0 * e.relative_residual(), e.max_growth);
  if (s.error)
    text += fmt::format(
        "estimated error of integration (sum of local errors / scale): position {:.2g}, velocity {:.2g}{}\n",
        s.error->position, s.error->velocity,
        s.phases > 0 ? fmt::format("; {} phases, remaps lost {:.3g} {}", s.phases, s.remap_loss, unit)
                     : fmt::format(", strain {:.2g}", s.error->strain));
  if (system_.filters || system_.flip < 1.0)
    text += fmt::format("filters removed {:.5g} {}\n", e.filtered, unit);
  for (const output::BodySummary& body : s.bodies)
    if (body.removed)
      text += fmt::format("'{}': {} particles removed, {:.5g} {} of {:.5g}\n", body.name, body.removed->first,
                          body.removed->second, system_.axisymmetric ? "kg" : "kg/m",
                          body.removed->second + body.motion.mass);
  const FailureReport& f = s.failure;
  for (const output::BodySummary& body : s.bodies)
    if (body.failure.first_damage || body.failure.first_localisation)
      text += fmt::format("'{}': first damage {}, first localisation {}, first separation {}\n", body.name,
                          place(body.failure.first_damage), place(body.failure.first_localisation),
                          place(body.failure.first_separation));
  text += fmt::format("{} localised, {} separated particles, {} fragments{}\n", f.localised, f.separated,
                      f.fragments.size(),
                      f.perforated ? (*f.perforated ? ", perforated" : ", not perforated") : "");
  text += fmt::format("results in {}\n", directory_.string());
  return text;
}

}  // namespace vitrum::app
