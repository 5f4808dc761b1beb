#include <algorithm>

#include "scene/checks.hpp"
#include "scene/suggestion.hpp"

namespace vitrum::scene {

void check_probes(const TableView& document, const Scene& scene) {
  std::vector<std::string> bodies;
  for (const BodyDefinition& body : scene.bodies) bodies.push_back(body.name);
  const std::vector<TableView> tables = document.tables("probe");
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const TableView& table = tables[k];
    const ProbeDefinition& probe = scene.probes[k];
    const auto before = scene.probes.begin() + static_cast<std::ptrdiff_t>(k);
    if (table.sound("name")) check_name(table, probe.name);
    if (table.sound("name") && std::find_if(scene.probes.begin(), before, [&](const ProbeDefinition& other) {
                                 return other.name == probe.name;
                               }) != before)
      table.fail("name", "a name that no other probe has");
    if (!bodies.empty() && table.sound("body") && std::ranges::find(bodies, probe.body) == bodies.end())
      table.fail("body",
                 with_suggestion("the name of a body: " + schema::quoted_list(bodies), probe.body, bodies));
  }
}

}  // namespace vitrum::scene
