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

A scene is a TOML file. Everything is SI (m, s, kg, Pa). Tension is positive; angles are not used.
The paper is *A Rate-Dependent Damage/Decohesion Model for Simulating Glass Fragmentation under Impact using the Material Point Method*; equation numbers are its.

Unknown keys, wrong types and values out of bounds are errors: all of a file at once, each with its line and column. Integers are taken where numbers are expected. A number is finite unless its row says that inf is admitted.

## Formulas

Wherever a number stands, a text that begins with `=` is a formula: `max = ["=R", "=5*mm"]`. It may use

- the numbers of `[parameters]`, each those before it;
- `mm um us ns ms GPa MPa kPa`, `pi`, and `g` (9.80665 m/s^2: the fall on Earth, no gram; scenes weigh nothing in grams);
- what [muParser](https://beltoforion.de/en/muparser/) knows: `+ - * / ^`, comparisons, `a ? b : c`, `sqrt`, `sin`, `exp`, `min`, ...

Formulas are evaluated when the scene is read. The resolved scene has their values, and the formulas behind them as comments, in the order of the values. A result within rounding of a decimal of twelve digits is that decimal: `=20*us` is 2e-5.

**Functions of time**: where a row admits them formulas may use `t`. A table may stand in place of the number: `{table = [[0.0, 0.0], [1e-5, -20.0]]}`, seconds and values by rising time, linear between and constant outside. Or `{csv = "FILE"}`, the same as two columns
of a file, relative to the scene's folder (`#` begins a comment, a first line in which nothing resembles a number is a heading).

**Functions of place**: there formulas may use `r` and `z`, or `x` and `y` in plane strain. What they are for: [loads](../howto/loads.md).

## The command line: `--set`

Any key can be given by its dotted path and as a TOML value: `--set time.end=1e-4`, `--set 'integrator.scheme="musl"'`.

- **Parameters**: `--set parameters.R=0.4` changes all formulas with `R`. A parameter that no formula names is refused. So is, in a resolved scene, another value of one whose formulas have become numbers (`evaluated`), by `--set` or by hand: set it in the scene that was resolved.
- **Items of a list** go by index from 0, those that have a `name` by that as well: `--set body.0.velocity.1=-800`, `--set body.cylinder.velocity.1=-800`. A name with dots, or of digits, stands in quotes: `--set 'body."2".velocity.1=-800'`.
- **Missing** keys and tables are created. Missing list items are not, except those of a list that has a default.
- **`none`** takes a key, a table or an item of a list away, as if the file did not have it. `--set material.glass.damage=none` is glass without damage. `--set boundary.0=none` leaves the first boundary out; those behind it move up. `none` is no TOML value, so that nothing else
  can be meant. What is not there cannot be removed.
- **In order**: the later wins. Setting `integrator.step` drops `integrator.courant`, and the other way round. The resolved scene, which `check` prints and results hold, has all of them applied.

## What is refused

`check` and `run` refuse a scene (status 2) before either takes memory:

- when the estimate of its peak memory is more than the machine, `ulimit -v` or the control group has to give;
- when its steps would take longer than a year at 4e6 particle-steps a second and thread (a warning from a day on);
- when a particle's mass, volume, kinetic energy or energy at the speed of a wave lies outside 1e-285 to 1e285, or times are so far from 0 that a step has fewer than 100 units of their last digit;
- when a file has more than 16 MB, a dotted key more than 64 parts, a polygon more than 10,000 vertices, the path of a point more than 1e8 rows.

`run` also refuses outputs that do not fit onto the disk.

`check` prints the estimates. They are within a factor of 2.5 of what runs take, for bodies that stay together: fragments that fly apart take a block of grid (10 kB) each. Time is counted at the rate above, which the reference case with the closed form reaches at least about.
With `substep` and `cvode` `check` adds a second figure, for a run in which no increment is elastic. It takes some increments of each material, in tension, shear and crushing, while it runs, and counts the slowest. A run lies between the two, as much of it is damaged or flows.
Outputs are counted apart: 3 ms each and 1 us a particle.

## What is warned of

What is valid but hardly meant: `check` and `run` warn of

- waves slower than 100 m/s or faster than 20 km/s, with the value that was probably meant;
- bodies that approach each other faster than waves travel in one of them;
- a duration in which waves pass through the largest body more than 100,000 times (explicit methods), or something flies a thousand times as far as that is wide: microseconds that are read as seconds;
- a scene in which nothing moves, a body that flies past everything, a boundary that no body is at or heads for;
- a disk or ring off the axis: a torus;
- a part of a `union` that adds nothing, a `hole` that cuts nothing out or is narrower than a cell;
- a pulse that comes after `time.end` or before `time.start`, a load that is 0 throughout, a table of other times than the run's;
- `scatter` by which the weakest and the strongest hundredth of particles differ more than a hundredfold, or of a volume so unlike a particle's that most bear 20 times the law's strength, or a 20th;
- bodies that do not touch but share nodes of the grid, so that one velocity field joins them;
- in a scene without `[contact]`, bodies that can meet: they are welded there.

The end of an adaptive run says whether its tolerance acted. Warnings go to standard error, and stand in `summary.json` and `check --json` as `warnings`.

`check` also prints, for each body, the mass of its shape and of its particles. For bodies within 4 cells, and each body's nearest, it prints the gap between the shapes, the distance of their nearest particles and the number of common nodes. For each boundary it prints the nodes with
mass in its box.

## Editors

Editors complete and check scenes by a JSON schema, which the program prints: `vitrum reference --schema > scene.schema.json` (`--schema=point`: of point files). A schema knows keys, types, bounds and choices; how values go together is what `check` knows.

With the line `#:schema ./scene.schema.json` at its top a scene is known to [taplo](https://taplo.tamasfe.dev) and to editors that use it (VS Code: Even Better TOML; Helix, Neovim and Emacs by its language server). For a folder of scenes `.taplo.toml` says so once:

    [[rule]]
    include = ["**/*.toml"]
    [rule.schema]
    path = "./scene.schema.json"

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
