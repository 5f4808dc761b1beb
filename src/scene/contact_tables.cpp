#include "scene/choices.hpp"
#include "scene/scene_tables.hpp"

namespace vitrum::scene {
namespace {

using schema::Field;
using schema::required;
using schema::Table;
using schema::table_of;

constexpr Bounds friction_bounds{0.0, intervals::infinite};

const Table& pair_table() {
  using P = ContactPair;
  static const Table table = table_of<P>(
      "[[contact.pair]]", "",
      {Field<P>("bodies", &P::bodies, "which", required).expecting("a list of the names of two bodies"),
       {"friction", &P::friction, "1", friction_bounds, "as in [contact]", required}});
  return table;
}

}  // namespace

const Table& contact_table() {
  using C = ContactDefinition;
  static const Table table = table_of<C>(
      "[contact]",
      "What happens where bodies meet. Without this table the method is `single`, and `check` and `run` "
      "warn of bodies that can meet.",
      {{"method", &C::method, contact_methods,
        "`single`: one velocity field, the original method's: bodies are welded where they meet, up to 2.2 "
        "cells early; `bodies`: a field for each body, and contact of their surfaces: they touch, slide and "
        "part"},
       {"friction", &C::friction, "1", friction_bounds,
        "bodies: Coulomb's coefficient; below its bound surfaces stick, by a spring as stiff as that of a "
        "penetration; inf: they stick wherever they are pressed together"},
       {"stiffness", &C::stiffness, "1", intervals::positive,
        "bodies: pressure of a penetration, relative to that of the two materials over a cell; stiffer is "
        "not better: 1 is about as stiff as the grid, and more shortens the steps of explicit methods"},
       {"depth",
        &C::depth,
        "cells",
        {0.0, 2.0, true, false},
        "bodies: penetration at which a surface gives way; the largest pressure is at half of it; absent: "
        "0.5, or what bears twice the pressure of the impact, if that is more, but 1 at most"},
       {"self", &C::self,
        "bodies: what cracks cut off a body comes off it: fragments have velocity fields of their own, fly "
        "apart, "
        "meet and slide as bodies do; else they share their body's field and stick where they meet"},
       {"pair", &C::pairs, pair_table(), "overrides for two bodies"}});
  return table;
}

}  // namespace vitrum::scene
