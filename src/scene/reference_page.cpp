#include "scene/reference_page.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "scene/scene_keys.hpp"

namespace vitrum {
namespace {

using namespace scene;

struct Section {
  std::string_view heading;
  std::string_view text;
  KeyTable keys;
};

constexpr std::string_view introduction =
    R"(# Scene reference

A scene is a TOML file. Everything is SI (m, s, kg, Pa); tension is positive; angles are not used. Unknown keys, wrong types and
values out of bounds are errors, all of a file at once, each with its line and column. Integers are taken where numbers are
expected. A number is finite unless its row says that inf is admitted.
The paper is *A Rate-Dependent Damage/Decohesion Model for Simulating Glass Fragmentation under Impact using the Material Point Method*; equation numbers are its.

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
(a torus), bodies that do not touch but share nodes of the grid, so that one velocity field joins them. The end of an adaptive run says whether its
tolerance acted. Warnings go to standard error, and stand in `summary.json` and `check --json` as `warnings`.

`check` prints for each body the mass of its shape and of its particles, for bodies within 4 cells and each body's nearest the gap between the shapes, the distance of
their nearest particles and the number of common nodes, and for each boundary the nodes with mass in its box.

This page is printed by the program from the tables that its reader uses; do not edit it.
)";

std::array<Section, 18> scene_sections() {
  return {{
      {"The file", "Tables of the document.", keys::scene()},
      {"[space]", "Geometry and grid.", keys::space()},
      {"[time]", "The time span.", keys::time()},
      {"[integrator]",
       "The grid momentum equations. Keys of a method that is not chosen are validated and ignored.",
       keys::integrator()},
      {"[constitutive]",
       "The local equations. Keys of a method that is not chosen are validated and ignored.",
       keys::constitutive()},
      {"[output]", "What is written, and when.", keys::output()},
      {"[[body]]", "One table for each body, with exactly one shape.", keys::body()},
      {"Shape `box` of a body", "`min` is less than `max` in both components.", keys::box()},
      {"Shape `disk` of a body",
       "In axisymmetric geometry a disk centred on the axis is a sphere, any other a torus about it. "
       "Particles at the "
       "rim of a disk, a ring or a polygon have the mass of their part of it.",
       keys::disk()},
      {"Shape `ring` of a body", "`inner` is less than `outer`.", keys::ring()},
      {"`perturbation` of a body",
       "Positions alone are displaced; masses and velocities stay those of the places before.",
       keys::perturbation()},
      {"[[boundary]]", "Grid nodes that are held or driven; the axis is handled by the geometry.",
       keys::boundary(Geometry::axisymmetric)},
      {"`box` of a boundary", "", keys::boundary_box()},
      {"[contact]",
       "What happens where bodies meet. Without this table the method is `single`, and `check` and `run` "
       "warn of "
       "bodies that can meet.",
       keys::contact()},
      {"[[contact.pair]]", "", keys::contact_pair()},
      {"[gravity]", "", keys::gravity()},
      {"[material.NAME]",
       "Isotropic elasticity; each table in it switches a model on. A model that is absent is "
       "neither stored nor run.",
       keys::material()},
      {"[material.NAME.damage]",
       "With damage, Poisson's ratio must be below 0.3926 (the root of nu^3 + nu^2 + 2 nu = 1): above, eqs. "
       "5, 6 and 8 "
       "make the shear modulus rise with the crack density.",
       keys::damage()},
  }};
}

std::array<Section, 4> model_sections() {
  return {{
      {"`rate` of damage as a table", "", keys::fixed_rate()},
      {"[material.NAME.drucker_prager]", "Excludes `von_mises`.", keys::drucker_prager()},
      {"[material.NAME.von_mises]",
       "`peak` is at least `yield`; equal: no hardening branch. `softening` = 0: perfectly plastic from the "
       "peak on. A "
       "peak above the yield strength needs `hardening` > 0.",
       keys::von_mises()},
      {"[material.NAME.decohesion]", "", keys::decohesion()},
  }};
}

std::array<Section, 3> point_sections() {
  return {{
      {"Point file", "`vitrum point` drives one material point along a strain path.", keys::point()},
      {"[state]",
       "State at the start of the path, e.g. of a particle whose increment failed (a run writes "
       "`failed_point.toml`).",
       keys::state()},
      {"[path]", "", keys::path()},
  }};
}

/// '|' would end a table cell and '<' begin an HTML tag.
std::string cell_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '|' || c == '<') result += '\\';
    result += c;
  }
  return result;
}

std::string key_row(const KeyInfo& key) {
  const std::string fallback = key.required           ? "required"
                               : key.fallback.empty() ? ""
                                                      : '`' + key.fallback + '`';
  return fmt::format("| `{}` | {} | {} | {} |\n", key.name, cell_text(key.expected), fallback,
                     cell_text(key.meaning));
}

std::string section_text(const Section& section) {
  const bool is_table = section.heading.front() == '[';
  std::string text = fmt::format("\n## {0}{1}{0}\n\n", is_table ? "`" : "", section.heading);
  if (!section.text.empty()) text += fmt::format("{}\n\n", section.text);
  text += "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const KeyInfo& key : section.keys) text += key_row(key);
  return text;
}

}  // namespace

std::string scene_reference() {
  std::string page(introduction);
  for (const Section& section : scene_sections()) page += section_text(section);
  for (const Section& section : model_sections()) page += section_text(section);
  for (const RegisteredLaw& law : registered_laws()) {
    const std::string heading = fmt::format("[material.NAME.{}]", law.table), text = law.text + '.';
    page += section_text({heading, text, keys::law(law)});
  }
  for (const Section& section : point_sections()) page += section_text(section);
  return page;
}

}  // namespace vitrum
