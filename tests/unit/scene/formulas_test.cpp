#include "malformed_input.hpp"
#include "scene/write_scene.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// The valid scene with parameters, and formulas in it.
std::string scene_of_parameters() {
  const std::string text = with(scene_text, "[space]", "[parameters]\nR = 0.2\nH = \"=R/50\"\n[space]");
  return with(with(text, "max = [0.2, 0.005]", "max = [\"=R\", \"=H\"]"), "cell = 1.0e-3",
              "cell = \"=1*mm\"");
}

}  // namespace

TEST_CASE("formulas stand for numbers, and --set of a parameter changes all that it is in", "[scene]") {
  const Scene scene = parse_scene(scene_of_parameters(), "s.toml");
  CHECK(scene.cell == 1.0e-3);
  CHECK(std::get<Box>(scene.bodies[0].shape).max == Vector2{0.2, 0.2 / 50});
  const Scene other = parse_scene(scene_of_parameters(), "s.toml",
                                  {"parameters.R=0.4", "parameters.H=\"=R/100\"", "title=\"=R\""});
  CHECK(std::get<Box>(other.bodies[0].shape).max == Vector2{0.4, 0.4 / 100});
  CHECK(other.title == "=R");  // no number stands there
  CHECK(parse_scene(scene_text, "s.toml", {"body.0.particles_per_cell=\"=2^2\""})
            .bodies[0]
            .particles_per_cell == 4);
}

TEST_CASE("units and constants of formulas", "[scene]") {
  const std::pair<const char*, double> values[] = {{"=1*mm", 1e-3},
                                                   {"=1*um", 1e-6},
                                                   {"=1*us", 1e-6},
                                                   {"=1*ns", 1e-9},
                                                   {"=1*ms", 1e-3},
                                                   {"=1*GPa", 1e9},
                                                   {"=1*MPa", 1e6},
                                                   {"=1*kPa", 1e3},
                                                   {"=-g", -9.80665},
                                                   {"=pi", std::acos(-1.0)},
                                                   {"=sqrt(2)", std::sqrt(2.0)},
                                                   {"=(1 < 2) ? 3 : 4", 3.0}};
  for (const auto& [formula, value] : values)
    CHECK(parse_scene(scene_text, "s.toml", {"gravity.acceleration=[0, \"" + std::string(formula) + "\"]"})
              .gravity[1] == value);
}

TEST_CASE("the resolved scene keeps formula and value", "[scene]") {
  const Scene scene = parse_scene(scene_of_parameters(), "s.toml");
  const std::string text = resolved_toml(scene);
  CHECK(text.find("parameters = {R = 0.2, H = 0.004}  # =R/50\n") != std::string::npos);
  CHECK(text.find("cell = 0.001  # =1*mm\n") != std::string::npos);
  CHECK(text.find("box = {min = [0.0, 0.0], max = [0.2, 0.004]}  # =R, =H\n") != std::string::npos);
  Scene again = parse_scene(text, "resolved");
  again.formulas = scene.formulas;
  CHECK(resolved_toml(again) == text);
}

TEST_CASE("formulas that cannot be", "[scene]") {
  require_scene_faults({
      {"cell = 1.0e-3",
       "cell = \"=1*mn\"",
       "s.toml:4:8: key 'space.cell': ",
       {"found \"=1*mn\"", "'mn' is no parameter, unit or function; did you mean 'mm'?"}},
      {"cell = 1.0e-3", "cell = \"=(1\"", "s.toml:4:8: key 'space.cell': ", {"expected a formula: "}},
      {"cell = 1.0e-3",
       "cell = \"=0,001\"",
       "s.toml:4:8: key 'space.cell': ",
       {"found 2 formulas with commas between, expected one"}},
      {"cell = 1.0e-3", "cell = \"=_pi\"", "s.toml:4:8: key 'space.cell': ", {"did you mean 'pi'?"}},
      {"cell = 1.0e-3", "cell = \"=\"", "s.toml:4:8: key 'space.cell': ", {"expected a formula: "}},
      {"cell = 1.0e-3",
       "cell = \"=-1*mm\"",
       "s.toml:4:8: key 'space.cell': ",
       {"expected a number in [1e-140, 1e+140] (m); the formula gives -0.001"}},
      {"cell = 1.0e-3", "cell = \"=0/0\"", "s.toml:4:8: key 'space.cell': ", {"the formula gives"}},
      {"cell = 1.0e-3", "cell = \"=t\"", "s.toml:4:8: key 'space.cell': ", {"'t' means nothing at this key"}},
      {"velocity = [0, -200.0]",
       "velocity = [0, \"=v\"]",
       "s.toml:18:16: key 'body.1.velocity.1': ",
       {"'v' is no"}},
      {"[space]\ngeometry",
       "[parameters]\nmm = 2\n[space]\ngeometry",
       "s.toml:3:6: key 'parameters.mm': ",
       {"no unit"}},
      {"[space]\ngeometry",
       "[parameters]\nr = 2\n[space]\ngeometry",
       "s.toml:3:5: key 'parameters.r': ",
       {"time and place"}},
      {"[space]\ngeometry",
       "[parameters]\nsin = 2\n[space]\ngeometry",
       "s.toml:3:7: key 'parameters.sin': ",
       {"no function"}},
      {"[space]\ngeometry",
       "[parameters]\n\"a b\" = 2\n[space]\ngeometry",
       "s.toml:3:9: key 'parameters.\"a b\"': ",
       {"letters"}},
  });
}
