#include <fmt/format.h>

#include <algorithm>

#include "scene/scene_keys.hpp"
#include "scene/sections.hpp"

namespace vitrum::scene {
namespace {

/// The keys of [[contact.pair]] for the bodies that there are.
std::vector<KeyInfo> pair_keys(const Scene& scene) {
  std::vector<KeyInfo> list(keys::contact_pair().begin(), keys::contact_pair().end());
  for (KeyInfo& key : list)
    if (key.name == "bodies")
      for (const BodyDefinition& body : scene.bodies) key.choices.push_back(body.name);
  return list;
}

/// Reads one [[contact.pair]]; reports pairs that were given before.
void read_pair(const TableReader& table, Scene& scene) {
  ContactPair pair;
  std::vector<std::string> names;
  table.read("friction", pair.friction);
  if (!table.read("bodies", names)) return;
  if (names.size() != 2) return table.fail("bodies", find_key(keys::contact_pair(), "bodies").expected);
  pair.bodies = {names[0], names[1]};
  const std::array<std::string, 2> reversed{names[1], names[0]};
  if (std::ranges::any_of(scene.contact.pairs, [&](const ContactPair& earlier) {
        return earlier.bodies == pair.bodies || earlier.bodies == reversed;
      }))
    return table.fail("bodies", "two bodies that no other [[contact.pair]] names");
  scene.contact.pairs.push_back(std::move(pair));
}

}  // namespace

void read_contact(const TableReader& document, Scene& scene) {
  const auto table = document.table("contact", keys::contact());
  if (!table) return;
  ContactDefinition& contact = scene.contact;
  contact.stated = true;
  table->read_choice("method", contact.method);
  table->read("friction", contact.friction);
  table->read("stiffness", contact.stiffness);
  table->read("depth", contact.depth);
  table->read("slip_speed", contact.slip_speed);
  const std::vector<KeyInfo> of_pair = pair_keys(scene);
  for (const TableReader& pair : table->tables("pair", of_pair)) read_pair(pair, scene);
}

}  // namespace vitrum::scene
