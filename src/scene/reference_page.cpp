#include "scene/reference_page.hpp"

#include <fmt/format.h>

#include <set>
#include <string_view>

#include "scene/scene_tables.hpp"
#include "scene/write_table.hpp"
#include "schema/json_schema.hpp"

namespace vitrum {
namespace {

using namespace scene;

constexpr std::string_view introduction =
    R"(# Scene reference

A scene is a TOML file. Everything is SI (m, s, kg, Pa); tension is positive; angles are not used. Unknown keys, wrong types and
values out of bounds are errors, all of a file at once, each with its line and column. Integers are taken where numbers are
expected. A number is finite unless its row says that inf is admitted.
The paper is *A Rate-Dependent Damage/Decohesion Model for Simulating Glass Fragmentation under Impact using the Material Point Method*; equation numbers are its.

Wherever a number stands, a text that begins with `=` is a formula: `max = ["=R", "=5*mm"]`. It may use the numbers of `[parameters]` (each those before it),
`mm um us ns ms GPa MPa kPa`, `g` (9.80665 m/s^2: the fall on Earth, no gram; scenes weigh nothing in grams), `pi`, and what [muParser](https://beltoforion.de/en/muparser/) knows (`+ - * / ^`, comparisons, `a ? b : c`, `sqrt`, `sin`, `exp`, `min`, ...).
`--set parameters.R=0.4` changes all formulas with `R`. Formulas are evaluated when the scene is read; the resolved scene has their values, and the formulas
behind them as comments. (A result within rounding of a decimal of twelve digits is that decimal: `=20*us` is 2e-5.)

Where functions of time may stand (see the rows), formulas may use `t`, and a table may stand in place of a number: `{table = [[0.0, 0.0], [1e-5, -20.0]]}`, seconds and
values by rising time, linear between and constant outside, or `{csv = "FILE"}`, the same as two columns of a file (relative to the scene's folder; `#` begins a comment, a first line without
numbers is a heading). Where functions of place may stand formulas may use `r` and `z`, or `x` and `y` in plane strain. What they are used for: [loads](../howto/loads.md).

Any key can be given on the command line, by its dotted path and as a TOML value: `--set time.end=1e-4`,
`--set 'integrator.scheme="musl"'`. Items of a list go by index from 0, those that have a `name` by that as well: `--set body.0.velocity.1=-800` and
`--set body.cylinder.velocity.1=-800` (a name with dots, or of digits, in quotes: `--set 'body."2".velocity.1=-800'`). Missing keys and tables are created,
missing list items are not, except those of a list that has a default.

`none` in place of a value takes a key, a table or an item of a list away, as if the file did not have it: `--set material.glass.damage=none` is glass
without damage, `--set boundary.0=none` leaves the first boundary out (those behind it move up). It is no TOML value, so that nothing else can be
meant. What is not there cannot be removed.

The arguments apply in order: the later wins. Setting `integrator.step` drops `integrator.courant` and the other way round. The resolved scene that `check`
prints and results hold is the scene with all of them applied.

A scene is refused (status 2), by `check` and by `run` before either takes memory, when the estimate of its peak memory is more than
the machine, `ulimit -v` or the control group has to give; when its steps would take longer than a year at 4e6 particle-steps a
second and thread (a warning from a day on); and, by `run`, when its outputs do not fit onto the disk. The estimates are of bodies
that stay together: fragments that fly apart take a block of grid (10 kB) each. `check` prints them; they are within a factor of 2.5 of what
runs take. Time is counted at that rate, which the reference case with the closed form reaches at least about; with `substep` and `cvode` `check` adds a
second figure, for a run in which no increment is elastic: it takes some increments of each material, in tension, shear and crushing, while it runs, and
counts the slowest. A run lies between the two, as much of it is damaged or flows. Outputs are counted apart: 3 ms each and 1 us a particle. A file has at most 16 MB, a dotted key 64 parts, a polygon 10,000 vertices, the path of a point 1e8 rows.

A particle whose mass, volume, kinetic energy or energy at the speed of a wave lies outside 1e-285 to 1e285 is refused, and so are times so far from 0 that
a step has fewer than 100 units of their last digit.

What is valid but hardly meant is warned of, by `check` and `run`: waves slower than 100 m/s or faster than 20 km/s (with the value that was probably meant), bodies that
approach each other faster than waves travel in one of them, a scene in which nothing moves, a body that flies past everything, a boundary that no body is at or heads for, a disk or ring off the axis
(a torus), bodies that do not touch but share nodes of the grid, so that one velocity field joins them, and, in a scene without `[contact]`, bodies that can meet: they are welded there. The end of an adaptive run says whether its
tolerance acted. Warnings go to standard error, and stand in `summary.json` and `check --json` as `warnings`.

`check` prints for each body the mass of its shape and of its particles, for bodies within 4 cells and each body's nearest the gap between the shapes, the distance of
their nearest particles and the number of common nodes, and for each boundary the nodes with mass in its box.

Editors complete and check scenes by a JSON schema, which the program prints: `vitrum reference --schema > scene.schema.json` (`--schema=point`: of point
files). With the line `#:schema ./scene.schema.json` at its top a scene is known to [taplo](https://taplo.tamasfe.dev) and to editors that use it (VS Code:
Even Better TOML; Helix, Neovim and Emacs by its language server); for a folder of scenes `.taplo.toml` says so once:

    [[rule]]
    include = ["**/*.toml"]
    [rule.schema]
    path = "./scene.schema.json"

A schema knows keys, types, bounds and choices; how values go together is what `check` knows.

This page is printed by the program from the tables that its reader uses; do not edit it.
)";

/// '|' would end a table cell and '<' begin an HTML tag.
std::string cell_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '|' || c == '<') result += '\\';
    result += c;
  }
  return result;
}

std::string key_row(const schema::Key& key) {
  const std::string fallback = key.required   ? "required"
                               : key.fallback ? '`' + value_text(*key.fallback) + '`'
                                              : "";
  return fmt::format("| `{}` | {} | {} | {} |\n", key.name, cell_text(expected(key)), fallback,
                     cell_text(key.text));
}

std::string section_text(const schema::Table& table) {
  const bool is_table = table.heading.front() == '[';
  std::string text = fmt::format("\n## {0}{1}{0}\n\n", is_table ? "`" : "", table.heading);
  if (!table.text.empty()) text += fmt::format("{}\n\n", table.text);
  text += "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const schema::Key& key : table.keys) text += key_row(key);
  return text;
}

}  // namespace

std::string scene_reference() {
  std::string page(introduction);
  std::set<const schema::Table*> printed;
  for (const schema::Table* file : {&scene_table(Geometry::axisymmetric), &point_table()})
    schema::visit_tables(*file, [&](const schema::Table& table) {
      if (printed.insert(&table).second) page += section_text(table);
    });
  return page;
}

std::string scene_schema() {
  return schema::json_schema(scene_table(Geometry::axisymmetric), "a scene of vitrum");
}

std::string point_schema() {
  return schema::json_schema(point_table(), "a point file of vitrum");
}

}  // namespace vitrum
