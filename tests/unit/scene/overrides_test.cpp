#include "malformed_input.hpp"
#include "scene/scene_differences.hpp"
#include "scene/write_scene.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

Scene scene_with(const std::vector<std::string>& overrides) {
  return parse_scene(scene_text, "s.toml", overrides);
}

std::vector<std::string> faults_with(const std::vector<std::string>& overrides) {
  return faults([&] { scene_with(overrides); });
}

void require_fault(const std::vector<std::string>& overrides, std::string_view start, std::string_view part) {
  const std::vector<std::string> messages = faults_with(overrides);
  for (const std::string& message : messages) UNSCOPED_INFO(message);
  REQUIRE(messages.size() == 1);
  CHECK(messages[0].starts_with(start));
  CHECK(messages[0].find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("Overrides (--set): replaces scalars, lists, list items and quoted keys", "[scene][overrides]") {
  const Scene scene = scene_with({"time.end = 2e-4", "body.1.velocity.1=-800", "body.0.box.max=[0.4, 0.005]",
                                  "material.\"glass\".damage.m=7", "integrator.scheme=\"musl\""});
  CHECK(scene.end == 2.0e-4);
  CHECK(scene.bodies[1].velocity == Vector2{0.0, -800.0});
  CHECK(std::get<Box>(scene.bodies[0].shape).max == Vector2{0.4, 0.005});
  CHECK(scene.materials[0].damage->m == 7.0);
  CHECK(scene.integrator.scheme == StepScheme::musl);
  CHECK(scene.overrides.size() == 5);
  CHECK(scene.verbatim == scene_text);
}

TEST_CASE("Overrides (--set): creates missing keys and tables", "[scene][overrides]") {
  const Scene scene =
      scene_with({"output.every=1e-5", "gravity.acceleration=[0, -9.81]", "time.start=-1e-5",
                  "material.ice.density=917", "material.ice.young=9e9", "material.ice.poisson=0.3"});
  CHECK(scene.output.every == 1.0e-5);
  CHECK(scene.gravity == Vector2{0.0, -9.81});
  CHECK(scene.start == -1.0e-5);
  REQUIRE(scene.materials.size() == 3);
  CHECK(scene.materials[2].name == "ice");
}

TEST_CASE("Overrides (--set): items of a list that the file leaves at its default", "[scene][overrides]") {
  const Scene scene = scene_with({"body.0.velocity.1=-800", "body.0.velocity.0=3",
                                  "body.0.velocity_gradient.0.1=5", "body.0.stress.3=1e6"});
  CHECK(scene.bodies[0].velocity == Vector2{3.0, -800.0});
  CHECK(scene.bodies[0].velocity_gradient[0] == Vector2{0.0, 5.0});
  CHECK(scene.bodies[0].velocity_gradient[1] == Vector2{0.0, 0.0});
  CHECK(scene.bodies[0].stress == std::array<double, 4>{0.0, 0.0, 0.0, 1e6});
}

TEST_CASE("Overrides (--set): of step and courant replaces the other", "[scene][overrides]") {
  const Scene courant = scene_with({"integrator.courant=0.1"});
  CHECK_FALSE(courant.integrator.step);
  CHECK(courant.integrator.courant == 0.1);
  const Scene later = scene_with({"integrator.courant=0.1", "integrator.step=1e-8"});
  CHECK(later.integrator.step == 1.0e-8);
  CHECK_FALSE(later.integrator.courant);
}

TEST_CASE("the later --set wins", "[scene][overrides]") {
  CHECK(scene_with({"time.end=1", "time.end=2"}).end == 2.0);
  CHECK(scene_with({"body.1.velocity.0=5", "body.1.velocity=[1, 2]"}).bodies[1].velocity ==
        Vector2{1.0, 2.0});
  CHECK(scene_with({"body.1.velocity=[1, 2]", "body.1.velocity.0=5"}).bodies[1].velocity ==
        Vector2{5.0, 2.0});
}

TEST_CASE("Overrides (--set): faults name the argument", "[scene][overrides]") {
  require_fault({"time.end=1", "integrator.stp=1"},
                "--set 2: key 'integrator.stp': ", "did you mean 'step'?");
  require_fault({"time.end=-1"}, "--set 1: key 'time.end': ", "found -1, expected a time later");
  require_fault({"body.1.velocity.1=inf"}, "--set 1: key 'body.1.velocity.1': ", "found inf");
  require_fault({"body.1.velocity=[1, 2]", "body.1.velocity.0=true"},
                "--set 2: key 'body.1.velocity.0': ", "true");
  require_fault({"material.ice={density=1, young=1}"},
                "--set 1: key 'material.ice.poisson': ", "found nothing");
  require_fault({"material.glass.poisson=0.45"}, "--set 1: key 'material.glass.poisson': ", "damage");
}

TEST_CASE("Overrides (--set): arguments that cannot be applied", "[scene][overrides]") {
  require_fault({"integrator.scheme=musl"},
                "--set 1: key 'integrator.scheme': found musl, expected a TOML value",
                "quote a string: --set 'integrator.scheme=\"musl\"'");
  require_fault({"body.2.velocity.1=-800"}, "--set 1: key 'body.2': ", "found index 2 of a list of length 2");
  require_fault({"body.0.box.min.5=0"}, "--set 1: key 'body.0.box.min.5': ", "length 2");
  require_fault({"body.first.name=\"x\""}, "--set 1: key 'body.first': ", "an index from 0 to 1");
  require_fault({"body.0.polygon.1=[0, 1]"},
                "--set 1: key 'body.0.polygon': ", "--set 'body.0.polygon=[..]'");
  require_fault({"body.0.velocity.2=-800"}, "--set 1: key 'body.0.velocity.2': ", "length 2");
  require_fault({"body.0.velocity.1.0=1"}, "--set 1: key 'body.0.velocity.1': ", "found a number");
  require_fault({"body.0.velocity.1=true"}, "--set 1: key 'body.0.velocity", "true");
  require_fault({"time.end.x=1"}, "--set 1: key 'time.end': ", "found 1e-04, expected a table or list");
  require_fault({"time.end"}, "--set 1: found \"time.end\"", "KEY=VALUE");
  require_fault({"=1"}, "--set 1: ", "KEY=VALUE");
  require_fault({"time..end=1"}, "--set 1: ", "KEY=VALUE");
  require_fault({"time.end="}, "--set 1: key 'time.end': found nothing", "a TOML value");
  require_fault({"time.end=1\n[body]"}, "--set 1: key 'time.end': ", "a TOML value");
  require_fault({"time.end=1 2"}, "--set 1: key 'time.end': ", "found 1 2");
}

TEST_CASE("Overrides (--set): items of a list by their names", "[scene][overrides]") {
  const Scene named = parse_scene(scene_text, "s.toml");
  const std::string first = named.bodies[0].name, second = named.bodies[1].name;
  CHECK(scene_with({"body." + second + ".velocity.1=-800"}).bodies[1].velocity[1] == -800.0);
  CHECK(scene_with({"body.\"" + first + "\".velocity=[1, 2]"}).bodies[0].velocity == Vector2{1.0, 2.0});
  // A name that the command line itself has given; one of digits, in quotes; one with a dot.
  const Scene renamed = scene_with({"body.0.name=\"1\"", "body.\"1\".velocity.0=3", "body.1.velocity.0=4",
                                    "body.1.name=\"a.b\"", "body.\"a.b\".velocity.1=5"});
  CHECK(renamed.bodies[0].velocity[0] == 3.0);
  CHECK(renamed.bodies[1].velocity == Vector2{4.0, 5.0});
  require_fault({"body." + first + "x.velocity.1=1"},
                "--set 1: key 'body." + first + "x': ", "did you mean '" + first + "'?");
  require_fault({"body.\"0\".velocity.1=1"}, "--set 1: key 'body.0': ", "found no item of this name");
  require_fault({"body." + second + ".velocity.1=true"}, "--set 1: key 'body.1.velocity", "found true");
  const auto ambiguous = faults_with({"body.1.name=\"" + first + "\"", "body." + first + ".velocity.1=1"});
  REQUIRE(ambiguous.size() == 2);
  CHECK(ambiguous[1].find("found 2 items of this name, expected an index: one of 0, 1") != std::string::npos);
}

TEST_CASE("Overrides (--set): none takes keys, tables and items away", "[scene][overrides]") {
  REQUIRE(parse_scene(scene_text, "s.toml").materials[0].damage);
  CHECK_FALSE(scene_with({"material.glass.damage=none"}).materials[0].damage);
  // The later argument wins, and a default comes back.
  CHECK(scene_with({"body.1.velocity=none"}).bodies[1].velocity == Vector2{0.0, 0.0});
  CHECK(scene_with({"integrator.step=none", "integrator.step=1e-8"}).integrator.step == 1e-8);
  const Scene one = scene_with({"body.0=none", "body.0.velocity.1=-5"});
  REQUIRE(one.bodies.size() == 1);
  CHECK(one.bodies[0].name == parse_scene(scene_text, "s.toml").bodies[1].name);
  CHECK(one.bodies[0].velocity[1] == -5.0);
  // What is removed is as if the file did not have it.
  const std::string removed = resolved_toml(scene_with({"material.glass.damage=none"}));
  CHECK(removed.find("[material.glass.damage]") == std::string::npos);
  CHECK(resolved_toml(parse_scene(removed, "r.toml")) == removed);
}

TEST_CASE("Overrides (--set): what none cannot take away", "[scene][overrides]") {
  require_fault({"material.glass.damge=none"},
                "--set 1: key 'material.glass.damge': ", "did you mean 'damage'?");
  require_fault({"material.glas.damage=none"}, "--set 1: key 'material.glas': ", "did you mean 'glass'?");
  require_fault({"body.7=none"}, "--set 1: key 'body.7': ", "length 2");
  require_fault({"material.glass.young=none"},
                "--set 1: key 'material.glass.young': ", "found nothing, expected");
  require_fault({"body.0.box.min.1=none"}, "--set 1: key 'body.0.box.min': ", "expected a list of 2");
  // Items behind one that is gone move up, and so does what is known of where their values come from.
  require_fault({"body.1.velocity.1=true", "body.0=none"},
                "--set 1: key 'body.0.velocity.1': ", "found true");
  require_fault({"body.0.velocity.1=true", "body.0=none", "body.0.velocity.0=false"},
                "--set 3: key 'body.0.velocity.0': ", "found false");
}

TEST_CASE("Two scenes differ in these keys", "[scene]") {
  const auto resolved = [](const std::vector<std::string>& overrides) {
    return resolved_toml(scene_with(overrides));
  };
  CHECK(scene_differences(resolved({}), resolved({})).empty());
  CHECK(scene_differences(resolved({"time.end=2e-4"}), resolved({})) ==
        std::vector<std::string>{"key 'time.end': found 2e-04, expected 1e-04"});
  CHECK(scene_differences(resolved({"output.every=1e-5", "body.1.velocity.0=5"}), resolved({})).size() == 2);
  CHECK(scene_differences(resolved({}), resolved({"output.every=1e-5"})) ==
        std::vector<std::string>{"key 'output.every': found nothing, expected 1e-05"});
}

TEST_CASE("faults of file and command line are reported together", "[scene][overrides]") {
  const auto messages = faults([] {
    parse_scene(with(scene_text, "cell = 1.0e-3", "cell = 0"), "s.toml", {"time.end=", "integrator.stp=1"});
  });
  REQUIRE(messages.size() == 3);
  CHECK(messages[0].starts_with("s.toml:4:8: "));
  CHECK(messages[1].starts_with("--set 1: "));
  CHECK(messages[2].starts_with("--set 2: "));
}

TEST_CASE("point files take --set too", "[scene][overrides]") {
  CHECK(parse_point(point_text, "p.toml", {"path.samples=7"}).samples == 7);
}
