#include "output/summary.hpp"

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

Json integrator_block(const std::string& method, const IntegratorCounters& counters) {
  const auto step = [&counters](double value) { return counters.steps > 0 ? number(value) : Json(nullptr); };
  return {{"method", method},
          {"steps", counters.steps},
          {"rejected", counters.rejected},
          {"rhs_evaluations", counters.rhs_evaluations},
          {"newton_iterations", counters.newton_iterations},
          {"factorisations", counters.factorisations},
          {"step_min", step(counters.step_min)},
          {"step_max", step(counters.step_max)},
          {"limited_by",
           {{"stability", counters.limited_by_stability},
            {"accuracy", counters.limited_by_accuracy},
            {"output", counters.limited_by_output}}}};
}

Json constitutive_block(const std::string& method, const ConstitutiveCounters& counters) {
  return {{"method", method},
          {"evaluations", counters.evaluations},
          {"cvode_solves", counters.cvode_solves},
          {"cvode_steps", counters.cvode_steps},
          {"cvode_rhs", counters.cvode_rhs},
          {"failures", counters.failures},
          {"events", counters.events}};
}

Json energy_block(const EnergyTotals& energy) {
  return {{"initial", number(energy.initial)},      {"kinetic", number(energy.kinetic)},
          {"elastic", number(energy.elastic)},      {"plastic", number(energy.plastic)},
          {"damage", number(energy.damage)},        {"fracture", number(energy.fracture)},
          {"snap_back", number(energy.snap_back)},  {"external", number(energy.external)},
          {"residual", number(energy.residual())},  {"relative_residual", number(energy.relative_residual())},
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

Json failure_block(const FailureReport& failure) {
  return {{"first_damage", first_event(failure.first_damage)},
          {"first_localisation", first_event(failure.first_localisation)},
          {"first_separation", first_event(failure.first_separation)},
          {"localised", failure.localised},
          {"separated", failure.separated},
          {"localised_radius_max", number(failure.localised_radius_max)},
          {"damage_threshold", damage_threshold},
          {"damage_front_radius", number(failure.damage_front_radius)},
          {"max_opening", number(failure.max_opening)},
          {"max_opening_radius", number(failure.max_opening_radius)},
          {"perforated", failure.perforated ? Json(*failure.perforated) : Json(nullptr)},
          {"fragments", fragments_block(failure.fragments)}};
}

Json body_block(const BodySummary& body) {
  return {{"particles", body.particles}, {"mass", number(body.mass)},       {"momentum", pair(body.momentum)},
          {"centre", pair(body.centre)}, {"kinetic", number(body.kinetic)}, {"localised", body.localised},
          {"separated", body.separated}};
}

}  // namespace

nlohmann::ordered_json to_json(const RunSummary& summary) {
  Json bodies = Json::object(), provenance = Json::object();
  for (const BodySummary& body : summary.bodies) bodies[body.name] = body_block(body);
  for (const ProvenanceEntry& entry : provenance_entries)
    provenance[std::string(entry.name)] = summary.provenance.*entry.member;
  return {{"status", status_name(summary.status)},
          {"message", summary.message.empty() ? Json(nullptr) : Json(summary.message)},
          {"time", number(summary.time)},
          {"particles", summary.particles},
          {"wall_seconds", number(summary.wall_seconds)},
          {"threads", summary.threads},
          {"integrator", integrator_block(summary.integrator_method, summary.integrator)},
          {"constitutive", constitutive_block(summary.constitutive_method, summary.constitutive)},
          {"energy", energy_block(summary.energy)},
          {"failure", failure_block(summary.failure)},
          {"bodies", bodies},
          {"provenance", provenance}};
}

void write_summary(const std::filesystem::path& path, const RunSummary& summary) {
  // A command line may hold bytes that are no UTF-8: they must not cost the summary.
  constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
  write_text_atomically(path, to_json(summary).dump(2, ' ', false, replace) + '\n');
}

}  // namespace vitrum::output
