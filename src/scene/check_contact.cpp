#include <fmt/format.h>

#include <algorithm>

#include "scene/checks.hpp"
#include "scene/suggestion.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

/// Reports names that no body has.
void check_names(const TableView& table, const ContactPair& pair, const std::vector<std::string>& bodies) {
  const toml::array& given = *table.toml().get("bodies")->as_array();
  for (std::size_t i = 0; i < given.size(); ++i)
    if (std::ranges::find(bodies, pair.bodies[i]) == bodies.end())
      table.fail_node(given[i], join_path(join_path(table.path(), "bodies"), i),
                      with_suggestion("one of " + schema::quoted_list(bodies), pair.bodies[i], bodies));
}

bool same_bodies(const ContactPair& a, const ContactPair& b) {
  return a.bodies == b.bodies || (a.bodies[0] == b.bodies[1] && a.bodies[1] == b.bodies[0]);
}

}  // namespace

void check_contact(const TableView& document, const Scene& scene) {
  const auto table = document.table("contact");
  if (!table) return;
  std::vector<std::string> bodies;
  for (const BodyDefinition& body : scene.bodies) bodies.push_back(body.name);
  const std::vector<TableView> tables = table->tables("pair");
  const std::vector<ContactPair>& pairs = scene.contact.pairs;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (tables[i].sound("bodies")) check_names(tables[i], pairs[i], bodies);
    if (tables[i].sound("bodies") &&
        std::any_of(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(i),
                    [&](const auto& other) { return same_bodies(other, pairs[i]); }))
      tables[i].fail("bodies", "two bodies that no other [[contact.pair]] names");
  }
}

}  // namespace vitrum::scene
