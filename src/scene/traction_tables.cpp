#include <algorithm>

#include "scene/choices.hpp"
#include "scene/scene_tables.hpp"
#include "schema/field.hpp"

namespace vitrum::scene {

using schema::Field;

namespace {

const schema::Table& blast_table() {
  using B = BlastDefinition;
  static const schema::Table table = schema::in_one_line(schema::table_of<B>(
      "`blast` of a traction",
      "The wave of a hemispherical charge of TNT on the ground, which meets the surface head-on: reflected "
      "pressure, "
      "duration, arrival and impulse by Swisdak's fits (1994) of the curves of Kingery and Bulmash, for "
      "scaled "
      "distances standoff / charge^(1/3) from 0.2 to 40 m/kg^(1/3), as a modified Friedlander pulse of that "
      "impulse.",
      {{"charge", &B::charge, "kg", intervals::positive, "mass of TNT", schema::required},
       {"standoff", &B::standoff, "m", intervals::positive, "distance of the charge", schema::required},
       {"arrival", &B::arrival, "s", intervals::finite,
        "when the front is at the surface; absent: as the fits say, the charge being fired at t = 0"}}));
  return table;
}

const schema::Table& friedlander_table() {
  using F = FriedlanderDefinition;
  static const schema::Table table = schema::in_one_line(schema::table_of<F>(
      "`friedlander` of a traction",
      "pressure (1 - s) exp(-decay s) with s = (t - arrival) / duration from 0 to 1.",
      {{"pressure", &F::pressure, "Pa", intervals::finite, "at the front", schema::required},
       {"duration", &F::duration, "s", intervals::positive, "of the positive phase", schema::required},
       {"decay", &F::decay, "1", {-20.0, 1e4}, "0: a triangle"},
       {"arrival", &F::arrival, "s", intervals::finite, "of the front"}}));
  return table;
}

Field<TractionDefinition> side_row() {
  using T = TractionDefinition;
  auto row = Field<T>::of(
      "side", {schema::Kind::text},
      "instead of `box`: where the outward normal points up (top), down, left (to the axis) or right, within "
      "45 "
      "degrees, or the edges of holes (inner), or all others (outer)",
      schema::Need::optional,
      [](const T& traction) -> std::optional<schema::Value> {
        if (!traction.side) return std::nullopt;
        return std::string(name_of(sides, *traction.side));
      },
      [](T& traction, const schema::Value& value) {
        traction.side = std::ranges::find(sides, std::get<std::string>(value), &Named<Side>::name)->value;
      });
  row.choices = schema::texts_of(sides);
  return row;
}

}  // namespace

const schema::Table& traction_table() {
  using T = TractionDefinition;
  static const schema::Table table = [] {
    schema::Table t = schema::table_of<T>(
        "[[traction]]",
        "A load on the part of a body's surface that lies in a box at the start, or on a side: the exact "
        "surface of its shape, carried by the particles next to it.",
        {{"body", &T::body, "name of a [[body]]", schema::required},
         {"box", &T::box, traction_box_table(), "what of the surface is loaded, at the start"},
         side_row(),
         Field<T>(
             "pressure", &T::pressure, "Pa", intervals::finite,
             "positive: against the outward normal; functions of place are taken where the surface was at "
             "the start")
             .over_time()
             .over_place(),
         Field<T>("vector", &T::vector, "Pa", intervals::finite,
                  "force per area (r, z) or (x, y), instead of `pressure`")
             .over_time()
             .over_place(),
         {"blast", &T::blast, blast_table(), "pressure of a charge, instead of `pressure`"},
         {"friedlander", &T::friedlander, friedlander_table(), "a pulse of pressure, instead of `pressure`"},
         {"follows", &T::follows,
          "pressure stays normal to the surface as it turns; false: it keeps its direction"}});
    t.alternatives = {{{"pressure", "vector", "blast", "friedlander"}, "load"}, {{"box", "side"}, "place"}};
    return t;
  }();
  return table;
}

}  // namespace vitrum::scene
