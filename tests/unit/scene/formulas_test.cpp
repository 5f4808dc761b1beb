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

TEST_CASE("formulas in the comments of a resolved scene stand in the order of their values", "[scene]") {
  std::string corners = "polygon=[";
  for (int n = 0; n < 12; ++n)
    corners += (n > 0 ? ", " : "") + std::string("[\"=") + std::to_string(n) + "*mm\", " +
               std::to_string(n * n) + "]";
  const std::string text =
      resolved_toml(parse_scene(scene_of_parameters(), "s.toml",
                                {"body.0.box=none", "body.0." + corners + "]",
                                 "boundary.0.box={max=[\"=3*R\", 1], min=[\"=R\", \"=-2\"]}"}));
  CHECK(text.find(
            "  # =0*mm, =1*mm, =2*mm, =3*mm, =4*mm, =5*mm, =6*mm, =7*mm, =8*mm, =9*mm, =10*mm, =11*mm\n") !=
        std::string::npos);
  CHECK(text.find("box = {min = [0.2, -2.0], max = [0.6, 1.0]}  # =R, =-2, =3*R\n") != std::string::npos);
}

TEST_CASE("a parameter that no formula asks for is not set in vain", "[scene]") {
  const auto told = [](std::string_view text, const std::string& setting) {
    return faults([&] { parse_scene(text, "s.toml", {"title=\"x\"", setting}); });
  };
  const std::string scene = scene_of_parameters();
  CHECK(told(scene, "parameters.R=0.3").empty());
  CHECK_THAT(told(scene, "parameters.RR=0.3").at(0),
             Catch::Equals("--set 2: key 'parameters.RR': found a parameter that no formula names, expected "
                           "one of \"R\", \"H\"; did you mean 'R'?"));
  CHECK_THAT(told(scene_text, "parameters.R=0.3").at(0),
             Catch::EndsWith("expected a formula with it: \"=R\""));

  // In a resolved scene formulas of numbers are numbers; those of time are as they were.
  const Scene driven = parse_scene(
      with(scene, "fix = [\"r\", \"z\"]", "fix = [\"r\", \"z\"]\nvelocity = [\"=-V*t\", \"=W*t/H\"]"),
      "s.toml", {"parameters.V=2", "parameters.W=3"});
  const std::string resolved = resolved_toml(driven);
  CHECK(resolved.find("evaluated = [\"R = 0.2\", \"H = 0.004\"]\n") != std::string::npos);
  CHECK(told(resolved, "parameters.V=3").empty());
  for (const char* setting : {"parameters.R=0.3", "parameters.H=1", "parameters={R=1, H=2, V=3, W=4}"})
    CHECK_THAT(told(resolved, setting).at(0),
               Catch::StartsWith("--set 2: key 'parameters.") &&
                   Catch::Contains(" in a resolved scene, where formulas with it are numbers by now, of ") &&
                   Catch::EndsWith("; expected it to be set in the scene that was resolved"));
  CHECK(told(resolved, "parameters.R=0.2").empty());  // as it was
  CHECK(told(scene_text, "evaluated=[]").empty());
  // So it is by hand.
  CHECK_THAT(told(with(resolved, "{R = 0.2,", "{R = 0.3,"), "title=\"y\"").at(0),
             Catch::StartsWith("s.toml:2:19: key 'parameters.R': found R = 0.3 in a resolved scene") &&
                 Catch::Contains(" of R = 0.2; "));
  CHECK(told(with(resolved, "V = 2.0", "V = 2.5"), "title=\"y\"").empty());
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
