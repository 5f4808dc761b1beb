#include <algorithm>
#include <limits>

#include "materials/registry.hpp"
#include "scene/choices.hpp"
#include "scene/scene.hpp"
#include "scene/scene_keys.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene::keys {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Bounds positive{0.0, infinite, true, true};
constexpr Bounds finite{-infinite, infinite, true, true};
constexpr Bounds fraction{0.0, 1.0, true, true};
/// Below, the rounding of one step's sums exceeds what is asked for.
constexpr Bounds tolerance{1.0e-13, 1.0, false, true};

KeyInfo integer_key(std::string_view name, int lowest, int highest, int fallback, std::string_view meaning) {
  KeyInfo key = other_key(
      name, "an integer from " + std::to_string(lowest) + " to " + std::to_string(highest), meaning);
  key.bounds = {static_cast<double>(lowest), static_cast<double>(highest)};
  return defaulted(std::move(key), std::to_string(fallback));
}

KeyInfo fields_key() {
  KeyInfo key = other_key("fields", "", "particle fields written; absent: all that the scene's models have");
  key.choices = output_fields();
  key.expected = "a list of " + quoted_list(key.choices);
  return key;
}

}  // namespace

KeyTable scene() {
  static const std::vector<KeyInfo> keys{
      defaulted(text_key("title", "shown in summaries and pictures"), "\"\""),
      required(other_key("space", "a table [space]", "geometry and grid")),
      required(other_key("time", "a table [time]", "time span")),
      required(other_key("integrator", "a table [integrator]", "the grid momentum equations")),
      other_key("constitutive", "a table [constitutive]", "the local equations of each particle"),
      other_key("output", "a table [output]", "what is written, and when"),
      required(other_key("body", "tables [[body]], at least one", "the bodies, in order")),
      other_key("boundary", "tables [[boundary]]", "grid nodes that are held or driven"),
      other_key("contact", "a table [contact]",
                "what happens where bodies meet; absent: they share one velocity field"),
      other_key("gravity", "a table [gravity]", "body force; absent: none"),
      required(other_key("material", "a table [material.NAME] for each material", "the materials")),
  };
  return keys;
}

KeyTable space() {
  static const std::vector<KeyInfo> keys{
      required(
          choice_key("geometry", geometry_names,
                     "coordinates (r, z) with the axis at r = 0, or (x, y) with no strain across the plane")),
      required(
          number_key("cell", {1e-140, 1e140}, "m", "side of the square grid cells; the grid is unbounded")),
      defaulted(choice_key("shape_functions", shape_function_names,
                           "`linear`: the hat functions of the original method"),
                "\"linear\""),
  };
  return keys;
}

KeyTable time() {
  static const std::vector<KeyInfo> keys{
      defaulted(number_key("start", finite, "s", "may be negative, so that t = 0 is first touch"),
                Scene{}.start),
      required(number_key("end", finite, "s", "later than `start`")),
  };
  return keys;
}

KeyTable integrator() {
  static const IntegratorDefinition standard;
  static const std::vector<KeyInfo> keys{
      required(choice_key("method", grid_method_names,
                          "steps of one of the explicit schemes, or an adaptive method of ARKODE")),
      defaulted(choice_key("scheme", scheme_names,
                           "explicit: when particle stress is updated: first, last, or last after a second "
                           "projection of velocity"),
                "\"usf\""),
      number_key("step", positive, "s", "explicit: fixed step, instead of `courant`"),
      defaulted(number_key("courant", positive, "1",
                           "explicit: adaptive step, this fraction of the critical one; used when neither it "
                           "nor `step` is given"),
                default_courant),
      defaulted(
          number_key("max_growth", {1.0, infinite, true, false}, "1",
                     "watchdog: the run fails when (kinetic + elastic) / (initial + external work) passes "
                     "this; inf: only non-finite values stop it"),
          standard.max_growth),
      integer_key("order", 2, 5, standard.order, "arkode-*: order of the Butcher table, instead of `table`"),
      text_key("table", "arkode-*: a Butcher table by its SUNDIALS name, instead of `order`"),
      defaulted(number_key("rtol", tolerance, "1", "arkode-*: tolerance relative to the scene's own scales"),
                standard.rtol),
      number_key("velocity_scale", positive, "m/s",
                 "arkode-*: scale of velocities; absent: the largest of initial speeds, prescribed "
                 "velocities and wave "
                 "speed x strain scale"),
      number_key("strain_scale", positive, "1",
                 "arkode-*: scale of strains; absent: the least elastic limit of the scene's materials"),
      number_key("fixed_step", positive, "s", "arkode-*: switches adaptivity off (convergence studies)"),
      number_key("max_step", positive, "s", "arkode-*: longest step"),
      number_key("min_step", positive, "s", "arkode-*: shortest step"),
      number_key("initial_step", positive, "s", "arkode-*: first step"),
      defaulted(choice_key("linear_solver", linear_solver_names, "arkode-implicit"),
                toml_quoted(standard.linear_solver)),
      defaulted(choice_key("preconditioner", preconditioner_names,
                           "arkode-implicit with gmres: a factored matrix of earlier steps, or a diagonal"),
                toml_quoted(standard.preconditioner)),
      number_key("remap", positive, "s",
                 "arkode-implicit: longest Lagrangian phase between remaps; absent: phases end by "
                 "`remap_travel` and `remap_strain` alone"),
      defaulted(number_key("remap_travel", positive, "cells",
                           "arkode-implicit: a phase ends when a node that matters has moved so far"),
                standard.remap_travel),
      defaulted(number_key("remap_strain", positive, "1",
                           "arkode-implicit: a phase ends when a particle has strained or turned so much"),
                standard.remap_strain),
  };
  return keys;
}

KeyTable constitutive() {
  static const ConstitutiveDefinition standard;
  static const std::vector<KeyInfo> keys{
      defaulted(
          choice_key("method", local_method_names, "return mappings, error-controlled substeps, or CVODE"),
          "\"closed-form\""),
      defaulted(number_key("rtol", tolerance, "1", "substep, cvode: relative tolerance"), standard.rtol),
      defaulted(number_key("atol", fraction, "1",
                           "substep, cvode: absolute tolerance, times each state's own scale"),
                standard.atol),
      defaulted(choice_key("solver", local_solver_names, "cvode: multistep family"),
                toml_quoted(standard.solver)),
  };
  return keys;
}

KeyTable output() {
  static const std::vector<KeyInfo> keys{
      number_key("every", positive, "s",
                 "time between outputs, which fall on its multiples, the start and the end; absent: only the "
                 "last state"),
      fields_key(),
      number_key("checkpoint_every", positive, "s", "time between checkpoints; absent: none but on a signal"),
  };
  return keys;
}

KeyTable gravity() {
  static const std::vector<KeyInfo> keys{
      required(list_key("acceleration", 2, finite, "m/s^2", "(r, z) or (x, y)")),
  };
  return keys;
}

KeyTable contact() {
  static const ContactDefinition standard;
  static const std::vector<KeyInfo> keys{
      defaulted(
          choice_key("method", contact_method_names,
                     "`single`: one velocity field, the original method's: bodies are welded where they "
                     "meet, up to 2.2 cells early; `bodies`: a field for each body, and contact of their "
                     "surfaces: they touch, slide and part"),
          "\"single\""),
      defaulted(
          number_key("friction", {0.0, infinite}, "1",
                     "bodies: Coulomb's coefficient; inf: bodies stick where they are pressed together"),
          standard.friction),
      defaulted(number_key("stiffness", positive, "1",
                           "bodies: pressure of a penetration, relative to that of the two materials over a "
                           "cell; stiffer is not better: 1 is about as stiff as the grid"),
                standard.stiffness),
      defaulted(
          number_key("depth", {0.0, 2.0, true, false}, "cells",
                     "bodies: penetration at which a surface gives way; the largest pressure is at half "
                     "of it"),
          standard.depth),
      number_key("slip_speed", positive, "m/s",
                 "bodies: friction has its full size from this speed on; absent: a hundredth of the largest "
                 "speed of the scene's start and boundaries"),
      other_key("pair", "tables [[contact.pair]]", "overrides for two bodies"),
  };
  return keys;
}

KeyTable contact_pair() {
  static const std::vector<KeyInfo> keys{
      required(other_key("bodies", "a list of the names of two bodies", "which")),
      required(number_key("friction", {0.0, infinite}, "1", "as in [contact]")),
  };
  return keys;
}

KeyTable point() {
  static const std::vector<KeyInfo> keys{
      required(other_key("material", "one table [material.NAME]", "the material, as in a scene")),
      other_key("constitutive", "a table [constitutive]", "as in a scene"),
      other_key("state", "a table [state]", "state at the start of the path (default: virgin)"),
      required(other_key("path", "a table [path]", "the strain path")),
  };
  return keys;
}

KeyTable state() {
  static const std::vector<KeyInfo> keys = [] {
    std::vector<KeyInfo> list{
        list_key("elastic_strain", 4, finite, "1", "elastic strain (rr, zz, tt, rz) or (xx, yy, zz, xy)")};
    for (const Component& c : all_columns()) {
      const bool of_unit_vector = c.bounds.lowest == -1.0;  // whose length rounding may leave above 1
      list.push_back(number_key(c.name, of_unit_vector ? finite : c.bounds, c.unit, c.text));
    }
    return list;
  }();
  return keys;
}

KeyTable path() {
  static const PointScene standard;
  static const std::vector<KeyInfo> keys{
      required([] {
        KeyInfo key =
            other_key("time", "a list of two or more increasing finite numbers (s)", "times of `strain`");
        key.bounds = finite;
        return key;
      }()),
      required([] {
        KeyInfo key = other_key(
            "strain", "a list of 4 finite numbers for each time",
            "total strain (rr, zz, tt, rz) or (xx, yy, zz, xy), tensor shear; linear between times");
        key.bounds = finite;
        return key;
      }()),
      required(
          number_key("size", positive, "m", "side of the cell around the point, for the effective length")),
      integer_key("samples", 1, 1'000'000, standard.samples, "rows written for each segment of the path"),
  };
  return keys;
}

const std::vector<std::string>& output_fields() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list{"position", "velocity", "stress", "elastic_strain", "damage"};
    for (const Component& column : all_columns())
      if (std::ranges::find(list, column.name) == list.end()) list.emplace_back(column.name);
    return list;
  }();
  return names;
}

}  // namespace vitrum::scene::keys
