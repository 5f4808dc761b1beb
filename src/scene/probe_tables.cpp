#include "scene/choices.hpp"
#include "scene/scene_tables.hpp"

namespace vitrum::scene {
namespace {

using schema::Field;
using schema::in_one_line;
using schema::required;
using schema::Table;
using schema::table_of;

const Table& line_table() {
  using L = ProbeLine;
  static const Table table =
      in_one_line(table_of<L>("`line` of a probe", "",
                              {{"from", &L::from, "m", intervals::finite, "the first point", required},
                               {"to", &L::to, "m", intervals::finite, "the last point", required},
                               {"count", &L::count, Bounds{2.0, 1.0e4}, "points, evenly spaced", required}}));
  return table;
}

}  // namespace

const Table& probe_table() {
  using P = ProbeDefinition;
  static const Table table = [] {
    Table t = table_of<P>(
        "[[probe]]", "Material points whose history goes to `probes.csv`; particles are chosen at the start.",
        {{"name", &P::name, "unique; names the probe in `probes.csv`", required},
         {"body", &P::body, "name of the [[body]] that it looks at", required},
         Field<P>::alternative<Vector2>("point", &P::place, "m", intervals::finite,
                                        "the particle nearest to it (exactly one of the three)"),
         Field<P>::alternative<ProbeLine>("line", &P::place, line_table(),
                                          "the particles nearest to its points"),
         Field<P>::alternative<Box>("box", &P::place, probe_box_table(),
                                    "all particles in it: their means")});
    t.alternatives = {{{"point", "line", "box"}, "place"}};
    return t;
  }();
  return table;
}

}  // namespace vitrum::scene
