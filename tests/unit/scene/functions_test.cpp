// Functions in place of numbers: reading, messages, the resolved scene, files beside the scene.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <span>

#include "malformed_input.hpp"
#include "scene/blast.hpp"
#include "scene/load_functions.hpp"
#include "scene/write_scene.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

const std::string driven =
    with(scene_text, "fix = [\"r\", \"z\"]", "fix = [\"r\", \"z\"]\nvelocity = [0, \"=-V*(t < 50*us)\"]");

std::string scene_with(const std::string& velocity) {
  return with(with(driven, "[0, \"=-V*(t < 50*us)\"]", velocity), "[space]",
              "[parameters]\nV = 20.0\n[space]");
}

}  // namespace

TEST_CASE("A formula of t is a function of time", "[scene][loads]") {
  const Scene scene = parse_scene(scene_with("[0, \"=-V*(t < 50*us)\"]"), "s.toml");
  CHECK(scene.boundaries[0].velocity == Vector2{0.0, 0.0});
  CHECK(scene.varies("boundary.0.velocity"));
  CHECK(scene.varies("boundary"));
  CHECK_FALSE(scene.varies("boundary.0.box"));
  CHECK_FALSE(scene.varies("bound"));
  const auto velocity = load_function(scene, "boundary.0.velocity.1");
  CHECK(velocity->at(49e-6) == -20.0);
  CHECK(velocity->at(51e-6) == 0.0);
  CHECK(mpm::integral(*velocity, 0.0, 1e-4) == Approx(-20.0 * 50e-6).epsilon(1e-10));
  CHECK(velocity->rate(50e-6, 1.0) == 0.0);  // a jump has none
  const auto smooth =
      load_function(parse_scene(scene_with("[0, \"=V*sin(1e4*t)\"]"), "s.toml"), "boundary.0.velocity.1");
  CHECK(smooth->rate(3e-5, 1.0) == Approx(20e4 * std::cos(0.3)).epsilon(1e-7));
  // Without t it is the number that it was.
  const Scene constant = parse_scene(scene_with("[0, \"=-V\"]"), "s.toml");
  CHECK(constant.boundaries[0].velocity[1] == -20.0);
  CHECK(constant.functions.empty());
}

TEST_CASE("The first row of a file is a heading only if nothing in it was meant as a number",
          "[scene][loads]") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "vitrum_heading_test";
  std::filesystem::create_directories(folder);
  const auto first_value = [&](const std::string& first_row) {
    std::ofstream(folder / "load.csv", std::ios::binary) << first_row << "\n1e-5,-4\n2e-5,2\n";
    return load_function(parse_scene(scene_with("[0, {csv = \"load.csv\"}]"), (folder / "s.toml").string()),
                         "boundary.0.velocity.1")
        ->at(0.0);
  };
  CHECK(first_value("\xEF\xBB\xBF"
                    "0,5") == 5.0);  // as spreadsheets write it
  CHECK(first_value("\xEF\xBB\xBFtime,v") == -4.0);
  CHECK(first_value("t (us), v") == -4.0);
  for (const char* row : {"0\t5", "1d-5,1", "\"0\",\"5\"", "0 s, 1", "nan,1", "inf,1", "0,O", "t,1"}) {
    CAPTURE(row);
    CHECK_THROWS_WITH(first_value(row), Catch::Contains("load.csv:1: found"));
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("A table that does not rise is refused at the row that breaks the order", "[scene][loads]") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "vitrum_order_test";
  std::filesystem::create_directories(folder);
  const auto told = [&](const std::string& text) {
    return faults([&] { parse_scene(scene_with(text), (folder / "s.toml").string()); }).at(0);
  };
  std::ofstream(folder / "load.csv") << "t,v\n# in order\n0,1\n2e-5,2\n\n1e-5,3\n";
  CHECK_THAT(told("[0, {csv = \"load.csv\"}]"),
             Catch::Contains("key 'boundary.0.velocity.1.csv': found 1e-05 s after 2e-05 s (load.csv:6), "
                             "expected rows [t, value] by rising time"));
  CHECK_THAT(told("[0, {table = [[0, 1], [2e-5, 2], [2e-5, 3]]}]"),
             Catch::Contains("s.toml:24:") &&
                 Catch::Contains("key 'boundary.0.velocity.1.table.2': found 2e-05 s after 2e-05 s"));
  std::ofstream(folder / "load.csv") << "0,1\n";
  CHECK_THAT(told("[0, {csv = \"load.csv\"}]"), Catch::Contains("two or more rows"));
  std::filesystem::remove_all(folder);
}

TEST_CASE("A file that is not there is called what it should be", "[scene][loads]") {
  const auto told = [&](const std::string& file) {
    return faults([&] { parse_scene(scene_with("[0, {csv = \"" + file + "\"}]"), "s.toml"); }).at(0);
  };
  for (const char* file : {"none.csv", "-"}) {  // no standard input
    CAPTURE(file);
    CHECK_THAT(told(file), Catch::StartsWith("s.toml:24:") &&
                               Catch::Contains("key 'boundary.0.velocity.1.csv': found ") &&
                               Catch::Contains("found no such file, expected a CSV file"));
  }
  CHECK_THAT(told("."), Catch::Contains("found a directory, expected a CSV file"));
}

TEST_CASE("Tables are piecewise linear, from the scene or from a file beside it", "[scene][loads]") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "vitrum_functions_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "die.csv") << "t,velocity\n# rises\n0, 0\n2e-5,-4\n\n6e-5 , 2\r\n";
  for (const char* text :
       {"[0, {table = [[0, 0], [\"=20*us\", -4], [60e-6, 2]]}]", "[0, {csv = \"die.csv\"}]"}) {
    const Scene scene = parse_scene(scene_with(text), (folder / "s.toml").string());
    const auto f = load_function(scene, "boundary.0.velocity.1");
    CHECK(f->at(-1.0) == 0.0);
    CHECK(f->at(1e-5) == Approx(-2.0));
    CHECK(f->at(5e-5) == Approx(0.5));
    CHECK(f->at(1.0) == 2.0);
    CHECK(f->next_kink(0.0) == 2e-5);
    CHECK(f->next_kink(2e-5) == 6e-5);
    CHECK(std::isinf(f->next_kink(6e-5)));
    CHECK(f->rate(2e-5, 2e-5) == Approx(-2e5));
    CHECK(f->rate(2e-5, 6e-5) == Approx(1.5e5));
    CHECK(mpm::integral(*f, 0.0, 8e-5) == Approx(-4e-5 - 4e-5 + 4e-5).epsilon(1e-12));
    CHECK(resolved_toml(scene).find(
              "velocity = [0.0, {table = [[0.0, 0.0], [2e-05, -4.0], [6e-05, 2.0]]}]") != std::string::npos);
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("The resolved scene reads as the same functions", "[scene][loads]") {
  const Scene scene =
      parse_scene(scene_with("[0, \"=-V*(t < 50*us)\"]"), "s.toml",
                  {"body.0.stress=[\"=1e6*r\", 0, 0, 0]", "gravity.acceleration=[0, \"=-t\"]"});
  const std::string text = resolved_toml(scene);
  CHECK(text.find("velocity = [0.0, \"=-V*(t < 50*us)\"]\n") != std::string::npos);
  CHECK(text.find("stress = [\"=1e6*r\", 0.0, 0.0, 0.0]\n") != std::string::npos);
  const Scene again = parse_scene(text, "resolved");
  CHECK(again.functions.size() == 3);
  CHECK(resolved_toml(again) == text);
}

TEST_CASE("Functions that cannot be", "[scene][loads]") {
  struct Case {
    std::string text;
    const char* place;
    std::vector<std::string> words;
  };
  const auto boundary = [](const std::string& velocity) { return scene_with(velocity); };
  const Case cases[] = {
      {boundary("[0, \"=-V*(r < 1)\"]"),
       "s.toml:24:16: key 'boundary.0.velocity.1': ",
       {"'r' means nothing"}},
      {boundary("[0, \"=-v*t\"]"),
       "s.toml:24:16: key 'boundary.0.velocity.1': ",
       {"'v' is no parameter", "'V'"}},
      {boundary("[0, \"=-V*(t <\"]"), "s.toml:24:16: key 'boundary.0.velocity.1': ", {"a formula"}},
      {boundary("[0, {table = [[0, 1]]}]"), "s.toml:24:", {"boundary.0.velocity.1", "two or more rows"}},
      {boundary("[0, {table = [[1, 1], [1, 2]]}]"), "s.toml:24:", {"by rising time"}},
      {boundary("[0, {table = [[0, 1], [1, \"=t\"]]}]"), "s.toml:24:", {"'t' means nothing"}},
      {boundary("[0, {csv = \"none.csv\"}]"), "s.toml:24:", {"none.csv", "no such file"}},
      {boundary("[0, {rows = 1}]"), "s.toml:24:", {"{table = [[t, value], ..]}"}},
      {with(scene_text, "velocity = [0, -200.0]", "velocity = [0, \"=t\"]"),
       "s.toml:18:16: key 'body.1.velocity.1': ",
       {"'t' means nothing"}},
      {with(scene_text, "velocity = [0, -200.0]", "velocity = [0, \"=x\"]"),
       "s.toml:18:16: key 'body.1.velocity.1': ",
       {"'x' means nothing"}},
      {with(boundary("[0, \"=t\"]"), "fix = [\"r\", \"z\"]", "fix = [\"r\"]"),
       "s.toml:24:12: key 'boundary.0.velocity': ",
       {"a function", "expected 0 or \"z\" in 'fix'"}},
  };
  for (const Case& c : cases) {
    CAPTURE(c.text, c.place);
    try {
      parse_scene(c.text, "s.toml");
      FAIL("no error");
    } catch (const InputError& error) {
      const std::string message = error.what();
      CAPTURE(message);
      CHECK(message.find(c.place) != std::string::npos);
      for (const std::string& word : c.words) CHECK(message.find(word) != std::string::npos);
    }
  }
}

TEST_CASE("20 us are 2e-5 s", "[scene][loads]") {
  for (const auto& [formula, value] : {std::pair{"=20*us", 2e-5}, {"=7*mm", 7e-3}, {"=3*ms/100", 3e-5}}) {
    const Scene scene = parse_scene(scene_text, "s.toml", {"time.end=\"" + std::string(formula) + "\""});
    CHECK(scene.end == value);
  }
  CHECK(parse_scene(scene_text, "s.toml", {"time.end=\"=1/3\""}).end == 1.0 / 3.0);
}

TEST_CASE("Blasts have the pressures of Kingery and Bulmash's curves", "[scene][loads]") {
  // 10 t at 500 m, as Swisdak's fits are printed by others: reflected 10.2446 kPa, arrival 1276.165 ms,
  // duration 133.2334 ms.
  const Pulse far = blast_pulse(1e4, 500.0);
  CHECK(far.pressure == Approx(10.2446e3).epsilon(1e-4));
  CHECK(far.arrival == Approx(1.276165).epsilon(1e-4));
  CHECK(far.duration == Approx(0.1332334).epsilon(1e-4));
  // The original curves (1984, hemispherical surface burst) are powers of U = a + b log10 Z; within 1 % (2 %
  // asked for): reflected pressure, kPa, and impulse, kPa ms/kg^(1/3).
  const double pressure_y[] = {3.40283217581,   -2.21030870597,   -0.218536586295,   0.895319589372,
                               0.24989009775,   -0.569249436807,  -0.11791682383,    0.224131161411,
                               0.0245620259375, -0.0455116002694, -0.00190930738887, 0.00361471193389};
  const double impulse_y[] = {2.70588058103, -0.949516092853, 0.112136118689, -0.0250659183287};
  const auto curve = [](std::span<const double> y, double a, double b, double Z) {
    const double U = a + b * std::log10(Z);
    double sum = 0.0;
    for (std::size_t k = y.size(); k-- > 0;) sum = sum * U + y[k];
    return std::pow(10.0, sum);
  };
  for (const double charge : {1.0, 5.0, 200.0})
    for (const double Z : {0.3, 0.6, 1.0, 1.8, 3.0, 6.0, 12.0, 25.0}) {
      CAPTURE(charge, Z);
      const double standoff = Z * std::cbrt(charge);
      const Pulse pulse = blast_pulse(charge, standoff);
      CHECK(pulse.pressure ==
            Approx(1e3 * curve(pressure_y, -0.240657322658, 1.36637719229, Z)).epsilon(0.01));
      CHECK(reflected_impulse(charge, standoff) ==
            Approx(std::cbrt(charge) * curve(impulse_y, -0.246208804814, 1.33422049854, Z)).epsilon(0.01));
      CHECK(pulse.impulse() == Approx(reflected_impulse(charge, standoff)).epsilon(1e-10));
      CHECK(mpm::integral(*pulse_function(pulse), 0.0, 1.1 * (pulse.arrival + pulse.duration)) ==
            Approx(pulse.impulse()).epsilon(1e-10));
    }
}
