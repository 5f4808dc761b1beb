#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/blast.hpp"
#include "scene/checks.hpp"
#include "scene/suggestion.hpp"

namespace vitrum::scene {

void check_tractions(const TableView& document, const Scene& scene) {
  std::vector<std::string> names;
  for (const BodyDefinition& body : scene.bodies) names.push_back(body.name);
  const std::vector<TableView> tables = document.tables("traction");
  for (std::size_t n = 0; n < tables.size(); ++n) {
    const TableView& table = tables[n];
    const TractionDefinition& traction = scene.tractions[n];
    if (table.has("body") && table.sound("body") && std::ranges::find(names, traction.body) == names.end())
      table.fail("body",
                 with_suggestion("a body of this file: " + schema::quoted_list(names), traction.body, names));
    if (const auto& box = traction.box;
        box && table.sound("box") && !(box->min[0] <= box->max[0] && box->min[1] <= box->max[1]))
      table.report("box", "found a component of 'max' less than that of 'min', expected none");
    if (table.sound("blast") && traction.blast) {
      const double distance = traction.blast->standoff / std::cbrt(traction.blast->charge);
      if (!(distance >= least_scaled_distance && distance <= largest_scaled_distance))
        table.report(
            "blast",
            fmt::format("found a scaled distance of {:.4g} m/kg^(1/3), expected {:g} to {:g}, which the fits "
                        "are for",
                        distance, least_scaled_distance, largest_scaled_distance));
    }
    if (traction.follows && traction.vector)
      table.report("follows",
                   "found together with 'vector', expected 'pressure': only it has a direction to follow");
  }
}

}  // namespace vitrum::scene
