#include "output/summary.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "output/atomic_file.hpp"

namespace vitrum::output {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
Json number(const std::optional<double>& value) {
  return value ? number(*value) : Json(nullptr);
}
template <class Pair>
Json pair(const Pair& values) {
  return Json::array({number(values[0]), number(values[1])});
}

const char* status_name(RunStatus status) {
  switch (status) {
    case RunStatus::complete:
      return "complete";
    case RunStatus::failed:
      return "failed";
    case RunStatus::interrupted:
      return "interrupted";
  }
  return "failed";
}

Json error_block(const std::optional<ErrorEstimate>& error) {
  if (!error) return nullptr;
  return {{"total", number(error->total)},
          {"position", number(error->position)},
          {"velocity", number(error->velocity)},
          {"strain", number(error->strain)}};
}

Json integrator_block(const RunSummary& summary) {
  const IntegratorCounters& counters = summary.integrator;
  const auto step = [&counters](double value) { return counters.steps > 0 ? number(value) : Json(nullptr); };
  return {{"method", summary.integrator_method},
          {"steps", counters.steps},
          {"rejected", counters.rejected},
          {"rhs_evaluations", counters.rhs_evaluations},
          {"newton_iterations", counters.newton_iterations},
          {"factorisations", counters.factorisations},
          {"factor_entries", counters.factor_entries},
          {"step_min", step(counters.step_min)},
          {"step_max", step(counters.step_max)},
          {"limited_by",
           {{"stability", counters.limited_by_stability},
            {"contact", counters.limited_by_contact},
            {"accuracy", counters.limited_by_accuracy},
            {"output", counters.limited_by_output},
            {"remap", counters.limited_by_remap}}},
          {"error_estimate", error_block(summary.error)},
          {"phases", summary.phases},
          {"remap_loss", number(summary.remap_loss)}};
}

Json constitutive_block(const std::string& method, const ConstitutiveCounters& counters) {
  const SolverCounters& s = counters.solver;
  const auto of_cvode = [&method](std::int64_t count) { return method == "cvode" ? count : 0; };
  return {{"method", method},
          {"evaluations", counters.evaluations},
          {"cvode_solves", of_cvode(s.solves)},
          {"cvode_steps", of_cvode(s.steps)},
          {"cvode_rhs", of_cvode(s.right_hand_sides)},
          {"increments_solved", s.increments},
          {"solves", s.solves},
          {"solver_steps", s.steps},
          {"solver_rhs", s.right_hand_sides},
          {"failures", s.failures},
          {"events", counters.events}};
}

Json energy_block(const EnergyTotals& energy, double ringing) {
  return {{"initial", number(energy.initial)},      {"kinetic", number(energy.kinetic)},
          {"elastic", number(energy.elastic)},      {"plastic", number(energy.plastic)},
          {"damage", number(energy.damage)},        {"fracture", number(energy.fracture)},
          {"snap_back", number(energy.snap_back)},  {"external", number(energy.external)},
          {"contact", number(energy.contact)},      {"friction", number(energy.friction)},
          {"residual", number(energy.residual())},  {"relative_residual", number(energy.relative_residual())},
          {"filtered", number(energy.filtered)},    {"ringing", number(ringing)},
          {"max_growth", number(energy.max_growth)}};
}

Json first_event(const std::optional<FirstEvent>& event) {
  if (!event) return nullptr;
  return {
      {"time", number(event->time)}, {"r", number(event->r)}, {"z", number(event->z)}, {"body", event->body}};
}

Json fragments_block(const std::vector<Fragment>& fragments) {
  double total = 0.0;
  Json list = Json::array();
  for (const Fragment& fragment : fragments) {
    total += fragment.mass;
    if (list.size() == listed_fragments) continue;
    list.push_back({{"body", fragment.body},
                    {"particles", fragment.particles},
                    {"mass", number(fragment.mass)},
                    {"centre", pair(fragment.centre)},
                    {"velocity", pair(fragment.velocity)}});
  }
  return {{"count", fragments.size()},
          {"largest_mass", fragments.empty() ? Json(nullptr) : number(fragments.front().mass)},
          {"total_mass", number(total)},
          {"list", list}};
}

void add_measures(Json& block, const FailureMeasures& measures) {
  block["first_damage"] = first_event(measures.first_damage);
  block["first_localisation"] = first_event(measures.first_localisation);
  block["first_separation"] = first_event(measures.first_separation);
  block["localised"] = measures.localised;
  block["separated"] = measures.separated;
  block["crack_area"] = number(measures.crack_area);
  block["localised_volume"] = number(measures.localised_volume);
  block["localised_radius_max"] = number(measures.localised_radius_max);
  block["damage_front_radius"] = number(measures.damage_front_radius);
  block["max_opening"] = number(measures.max_opening);
  block["max_opening_radius"] = number(measures.max_opening_radius);
}

Json failure_block(const FailureReport& failure) {
  Json block = {{"damage_threshold", damage_threshold}};
  add_measures(block, failure);
  block["perforated"] = failure.perforated ? Json(*failure.perforated) : Json(nullptr);
  block["fragments"] = fragments_block(failure.fragments);
  return block;
}

Json body_block(const BodySummary& body, const std::vector<Fragment>& fragments) {
  Json block = {{"particles", body.particles},
                {"mass", number(body.motion.mass)},
                {"momentum", pair(body.motion.momentum)},
                {"centre", pair(body.motion.centre)},
                {"kinetic", number(body.motion.kinetic)}};
  add_measures(block, body.failure);
  const auto pieces = std::ranges::count(fragments, body.name, &Fragment::body);
  block["fragments"] = body.failure.separated > 0 ? pieces : 1;
  if (body.removed) {
    block["removed"] = body.removed->first;
    block["removed_mass"] = number(body.removed->second);
  }
  return block;
}

}  // namespace

nlohmann::ordered_json to_json(const RunSummary& summary) {
  Json contacts = Json::array();
  for (const ContactSummary& contact : summary.contacts)
    contacts.push_back({{"bodies", contact.bodies},
                        {"impulse", {number(contact.impulse[0]), number(contact.impulse[1])}},
                        {"friction_work", number(contact.friction_work)},
                        {"least_gap", number(contact.least_gap)}});
  Json energy = energy_block(summary.energy, summary.ringing);
  if (std::ranges::any_of(summary.bodies, [](const BodySummary& body) { return body.removed.has_value(); }))
    energy["removed"] = number(summary.energy.removed);
  Json bodies = Json::object(), provenance = Json::object();
  for (const BodySummary& body : summary.bodies)
    bodies[body.name] = body_block(body, summary.failure.fragments);
  for (const ProvenanceEntry& entry : provenance_entries)
    provenance[std::string(entry.name)] = summary.provenance.*entry.member;
  return {{"status", status_name(summary.status)},
          {"message", summary.message.empty() ? Json(nullptr) : Json(summary.message)},
          {"warnings", summary.warnings},
          {"time", number(summary.time)},
          {"particles", summary.particles},
          {"wall_seconds", number(summary.wall_seconds)},
          {"total_seconds", number(summary.total_seconds)},
          {"threads", summary.threads},
          {"integrator", integrator_block(summary)},
          {"constitutive", constitutive_block(summary.constitutive_method, summary.constitutive)},
          {"energy", energy},
          {"failure", failure_block(summary.failure)},
          {"bodies", bodies},
          {"contacts", contacts},
          {"provenance", provenance}};
}

void write_summary(const std::filesystem::path& path, const RunSummary& summary) {
  // A command line may hold bytes that are no UTF-8: they must not cost the summary.
  constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
  write_text_atomically(path, to_json(summary).dump(2, ' ', false, replace) + '\n');
}

}  // namespace vitrum::output
