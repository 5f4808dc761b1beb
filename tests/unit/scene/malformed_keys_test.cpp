#include "malformed_input.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("the valid texts are valid", "[scene]") {
  CHECK_NOTHROW(parse_scene(scene_text, "s.toml"));
  CHECK_NOTHROW(parse_point(point_text, "p.toml"));
}

TEST_CASE("TOML syntax errors name line and column", "[scene]") {
  require_scene_faults({
      {"cell = 1.0e-3", "cell = ", "s.toml:4:8: ", {"Error while parsing"}},
      {"cell = 1.0e-3", "cell = 1.0e-3\ncell = 2", "s.toml:5:", {"redefine", "cell"}},
      {"title = \"test\"", "title = \"test", "s.toml:1:14: ", {}},
      {"title = \"test\"", "title = bare", "s.toml:1:9: ", {}},
      {"step = 1.0e-7", "step = 1.0e999", "s.toml:9:", {"1.0e999"}},
  });
}

TEST_CASE("unknown keys are errors with the nearest known key", "[scene]") {
  require_scene_faults({
      {"title =", "titel =", "s.toml:1:1: key 'titel': ", {"found an unknown key", "did you mean 'title'?"}},
      {"step =",
       "stp =",
       "s.toml:9:1: key 'integrator.stp': ",
       {"expected one of method, scheme, step", "did you mean 'step'?"}},
      {"[[boundary]]", "[[boundry]]", "s.toml:19:3: key 'boundry': ", {"did you mean 'boundary'?"}},
      {"velocity = [0, -200.0]",
       "velocty = [0, -200.0]",
       "s.toml:18:1: key 'body.1.velocty': ",
       {"did you mean 'velocity'?"}},
      {"toughness = 0.83e6",
       "toughness = 0.83e6\nzzzzzzzz = 1",
       "s.toml:28:1: key 'material.glass.damage.zzzzzzzz': ",
       {"unknown key"}},
      {"[material.glass.damage]",
       "[material.glass.damge]",
       "s.toml:26:17: key 'material.glass.damge': ",
       {"did you mean 'damage'?"}},
      {"radius = 0.004}",
       "radius = 0.004, r = 1}",
       "s.toml:17:45: key 'body.1.disk.r': ",
       {"expected one of centre, radius"}},
      {"m = 6",
       "m = 6\nrate = {fixd = 1e3, fixed = 1e3}",
       "s.toml:30:9: key 'material.glass.damage.rate.fixd': ",
       {"did you mean 'fixed'?"}},
      {"title =", "\"a\\nb\" = 1\ntitle =", "s.toml:1:1: key '\"a\\nb\"': ", {"unknown key"}},
  });
}

TEST_CASE("missing required keys are reported at their table", "[scene]") {
  require_scene_faults({
      {"cell = 1.0e-3",
       "",
       "s.toml:2:1: key 'space.cell': ",
       {"found nothing", "expected a number in [1e-140, 1e+140] (m)"}},
      {"geometry = \"axisymmetric\"",
       "",
       "s.toml:2:1: key 'space.geometry': ",
       {"found nothing", "\"plane-strain\""}},
      {"end = 1.0e-4", "", "s.toml:5:1: key 'time.end': ", {"found nothing"}},
      {"[time]\nend = 1.0e-4", "", "s.toml:1:1: key 'time': ", {"found nothing", "[time]"}},
      {"method = \"explicit\"", "", "s.toml:7:1: key 'integrator.method': ", {"found nothing"}},
      {"name = \"rod\"", "", "s.toml:14:1: key 'body.1.name': ", {"found nothing", "a string"}},
      {"density = 7800", "", "s.toml:30:1: key 'material.steel.density': ", {"found nothing", "(kg/m^3)"}},
      {"k = 5e26", "", "s.toml:26:1: key 'material.glass.damage.k': ", {"found nothing"}},
      {"fix = [\"r\", \"z\"]", "", "s.toml:19:1: key 'boundary.0.fix': ", {"found nothing"}},
      {"radius = 0.004", "", "s.toml:17:", {}},
      {"disk = {centre = [0, 0.01], radius = 0.004}",
       "",
       "s.toml:14:1: key 'body.1': ",
       {"found no shape", "exactly one of box, disk, ring, polygon, image, union"}},
  });
}

TEST_CASE("wrong types are errors", "[scene]") {
  require_scene_faults({
      {"title = \"test\"", "title = 3", "s.toml:1:9: key 'title': ", {"found 3, expected a string"}},
      {"cell = 1.0e-3",
       "cell = \"1 mm\"",
       "s.toml:4:8: key 'space.cell': ",
       {"found \"1 mm\"", "expected a number in [1e-140, 1e+140] (m)"}},
      {"cell = 1.0e-3", "cell = true", "s.toml:4:8: key 'space.cell': ", {"found true"}},
      {"cell = 1.0e-3", "cell = 1979-05-27", "s.toml:4:8: key 'space.cell': ", {"found a date or time"}},
      {"velocity = [0, -200.0]",
       "velocity = -200.0",
       "s.toml:18:12: key 'body.1.velocity': ",
       {"found -200.0", "a list of 2 finite numbers or formulas of place (m/s)"}},
      {"velocity = [0, -200.0]",
       "velocity = [0, 1, 2]",
       "s.toml:18:12: key 'body.1.velocity': ",
       {"found a list of 3"}},
      {"velocity = [0, -200.0]",
       "velocity = [0, \"x\"]",
       "s.toml:18:16: key 'body.1.velocity.1': ",
       {"found \"x\""}},
      {"velocity = [0, -200.0]",
       "particles_per_cell = 4.0",
       "s.toml:18:22: key 'body.1.particles_per_cell': ",
       {"found 4.0", "1, 4, 9 or 16"}},
      {"velocity = [0, -200.0]",
       "stress = [0, 0, 0]",
       "s.toml:18:10: key 'body.1.stress': ",
       {"found a list of 3", "a list of 4"}},
      {"velocity = [0, -200.0]",
       "velocity_gradient = [[0, 0]]",
       "s.toml:18:21: key 'body.1.velocity_gradient': ",
       {"2 rows of 2"}},
      {"velocity = [0, -200.0]",
       "velocity_gradient = [[0, 0], [0]]",
       "s.toml:18:30: key 'body.1.velocity_gradient.1': ",
       {"a list of 1"}},
      {"disk = {centre = [0, 0.01], radius = 0.004}",
       "disk = 0.004",
       "s.toml:17:8: key 'body.1.disk': ",
       {"found 0.004, expected a table"}},
      {"[[boundary]]",
       "[boundary]",
       "s.toml:19:1: key 'boundary': ",
       {"found a table, expected tables [[boundary]]"}},
      {"m = 6",
       "m = 6\nrate = 5",
       "s.toml:30:8: key 'material.glass.damage.rate': ",
       {"found 5", "{fixed = RATE}"}},
      {"title = \"test\"",
       "title = \"test\"\ngravity = 1",
       "s.toml:2:11: key 'gravity': ",
       {"found 1, expected a table"}},
      {"step = 1.0e-7",
       "step = 1.0e-7\norder = 3.0",
       "s.toml:10:9: key 'integrator.order': ",
       {"found 3.0", "an integer from 2 to 5"}},
  });
}

TEST_CASE("Butcher tables are of the kind that the method takes, and known to SUNDIALS", "[scene]") {
  require_scene_faults({
      {"method = \"explicit\"",
       "method = \"arkode-explicit\"\ntable = \"ARKODE_KVAERNO_4_2_3\"",
       "s.toml:9:9: key 'integrator.table': ",
       {"explicit Butcher table"}},
      {"method = \"explicit\"",
       "method = \"arkode-implicit\"\ntable = \"ARKODE_KVAERNO_4_2_4\"",
       "s.toml:9:9: key 'integrator.table': ",
       {"diagonally implicit Butcher table", "did you mean 'ARKODE_KVAERNO_4_2_3'?"}},
      {"method = \"explicit\"",
       "method = \"explicit\"\ntable = \"ARKODE_RK4\"",
       "s.toml:9:9: key 'integrator.table': ",
       {"found \"ARKODE_RK4\"", "name of a Butcher table"}},
      {"method = \"explicit\"",
       "method = \"arkode-explicit\"\ntable = \"ARKODE_KNOTH_WOLKE_3_3\"",
       "s.toml:9:9: key 'integrator.table': ",
       {"an embedding, or 'integrator.fixed_step'"}},
  });
}

TEST_CASE("all faults of a file are reported, in its order", "[scene]") {
  std::string text = with(scene_text, "cell = 1.0e-3", "cell = -1");
  text = with(text, "step = 1.0e-7", "stp = 1.0e-7");
  text = with(text, "poisson = 0.25\n[material.steel.von", "poisson = 0.7\n[material.steel.von");
  const auto messages = faults([&] { parse_scene(text, "s.toml"); });
  REQUIRE(messages.size() == 3);
  CHECK(messages[0].starts_with("s.toml:4:8: "));
  CHECK(messages[1].starts_with("s.toml:9:1: "));
  CHECK(messages[2].starts_with("s.toml:33:11: "));
}

TEST_CASE("an empty file lacks every required table", "[scene]") {
  CHECK(faults([] { parse_scene("", "s.toml"); }).size() == 5);
  CHECK(faults([] { parse_scene("body = []\nmaterial = {}", "s.toml"); }).size() == 5);
}

TEST_CASE("malformed point files", "[scene]") {
  const std::vector<Malformed> inputs{
      {"time = [0, 1e-6, 2e-6]", "time = [0, 2e-6, 1e-6]", "s.toml:6:8: key 'path.time': ", {"increasing"}},
      {"time = [0, 1e-6, 2e-6]",
       "time = [0, 1e-6]",
       "s.toml:7:10: key 'path.strain': ",
       {"found a list of 3", "2 strains"}},
      {"time = [0, 1e-6, 2e-6]", "time = [0]", "s.toml:6:8: key 'path.time': ", {"two or more"}},
      {"[0, 0, 0, 1e-4]", "[0, 0, 0]", "s.toml:7:42: key 'path.strain.2': ", {"found a list of 3"}},
      {"size = 1e-3", "size = 0", "s.toml:8:8: key 'path.size': ", {"found 0"}},
      {"size = 1e-3", "size = 1e-3\nsamples = 0", "s.toml:9:11: key 'path.samples': ", {"from 1 to 1000000"}},
      {"[path]",
       "[material.b]\ndensity = 1\nyoung = 1\npoisson = 0\n[path]",
       "s.toml:1:1: key 'material': ",
       {"found 2 materials, expected one"}},
      {"[path]", "[space]\ncell = 1\n[path]", "s.toml:5:2: key 'space': ", {"unknown key"}},
  };
  for (const Malformed& input : inputs)
    require_single_fault(input, point_text, [](auto text, auto name) { parse_point(text, name); });
}
