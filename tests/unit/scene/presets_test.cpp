#include <algorithm>

#include "malformed_input.hpp"
#include "materials/law.hpp"
#include "scene/presets.hpp"
#include "scene/write_scene.hpp"
#include "vitrum_source_dir.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

const std::string glass_keys =
    "density = 2500\nyoung = 72e9\npoisson = 0.25\n[material.glass.damage]\ntoughness = 0.83e6\nk = 5e26\nm "
    "= 6\n";

/// The valid scene with other lines for its glass.
Scene scene_of(std::string_view glass, const std::vector<std::string>& overrides = {}) {
  return parse_scene(with(scene_text, glass_keys, glass), "s.toml", overrides);
}
const MaterialParameters& glass_of(const Scene& scene) {
  return *std::ranges::find(scene.materials, "glass", &MaterialParameters::name);
}

}  // namespace

TEST_CASE("Presets: every number has a source, and every preset makes a material", "[scene][presets]") {
  REQUIRE(scene::presets().size() == 9);
  for (const auto& [name, preset] : scene::presets()) {
    CAPTURE(name.str());
    toml::table keys = *preset.as_table();
    CHECK(keys["text"].is_string());
    const toml::table sources = *keys["source"].as_table();
    for (const char* key : {"text", "source"}) keys.erase(key);
    for (const auto& [key, value] : keys) {
      CAPTURE(key.str());
      CHECK(sources.contains(key.str()));
    }
    CHECK(sources.size() == keys.size());
    const Scene scene = scene_of("preset = \"" + std::string(name.str()) + "\"\n");
    CHECK(scene.warnings.empty());
    CHECK(make_material(glass_of(scene), 1.0e-3)->wave_speed() > 1000.0);
    // The resolved scene shows the values, and is the same scene.
    const std::string resolved = resolved_toml(scene);
    CHECK(resolved.find("preset") == std::string::npos);
    CHECK(resolved_toml(parse_scene(resolved, "resolved.toml", {})) == resolved);
    CHECK(materials_page().find("## `" + std::string(name.str()) + "`") != std::string::npos);
  }
}

TEST_CASE("Presets: those of the paper are the reference case's materials", "[scene][presets]") {
  const Scene paper = read_scene(VITRUM_SOURCE_DIR "/studies/paper/reference.toml");
  const std::vector<std::string> chosen{"material.glass={preset=\"soda-lime, paper\"}",
                                        "material.steel={preset=\"steel, paper\"}"};
  CHECK(resolved_toml(read_scene(VITRUM_SOURCE_DIR "/studies/paper/reference.toml", chosen)) ==
        resolved_toml(paper));
}

TEST_CASE("Presets: the scene's own keys come first, wherever they stand", "[scene][presets]") {
  const MaterialParameters own =
      glass_of(scene_of("preset = \"soda-lime, paper\"\nyoung = 70e9\n[material.glass.damage]\nm = 7\n"));
  CHECK(own.elastic.young == 70.0e9);
  CHECK(own.elastic.density == 2500.0);
  CHECK(own.damage->m == 7.0);
  CHECK(own.damage->toughness == 0.83e6);
  CHECK(own.decohesion.has_value());

  const MaterialParameters set = glass_of(
      scene_of("preset = \"copper\"\n", {"material.glass.damage.m=7", "material.glass.decohesion=none",
                                         "material.glass.preset=\"soda-lime, paper\""}));
  CHECK(set.damage->m == 7.0);
  CHECK(set.damage->toughness == 0.83e6);
  CHECK_FALSE(set.decohesion.has_value());
  CHECK(set.elastic.young == 72.0e9);
  const MaterialParameters whole =
      glass_of(scene_of("preset = \"copper\"\n", {"material.glass={preset=\"borosilicate\", density=2300}"}));
  CHECK(whole.elastic.young == 64.0e9);
  CHECK(whole.elastic.density == 2300.0);
}

TEST_CASE("Presets: faults name the place of the preset", "[scene][presets]") {
  const auto require_faults = [](std::string_view glass, std::size_t count, std::string_view start,
                                 std::string_view part, const std::vector<std::string>& overrides = {}) {
    const std::vector<std::string> messages = faults([&] { scene_of(glass, overrides); });
    for (const std::string& message : messages) UNSCOPED_INFO(message);
    REQUIRE(messages.size() == count);
    for (const std::string& message : messages) {
      CHECK(message.starts_with(start));
      CHECK(message.find(part) != std::string::npos);
    }
  };
  const std::string elastic = "density = 2500\nyoung = 1e9\npoisson = 0.1\n";
  require_faults("preset = \"cooper\"\n" + elastic, 1,
                 "s.toml:23:10: key 'material.glass.preset': found \"cooper\"", "did you mean 'copper'?");
  require_faults("preset = 5\n" + elastic, 1, "s.toml:23:10: key 'material.glass.preset'",
                 "expected one of \"PVB\"");
  require_faults(elastic, 1, "--set 1: key 'material.glass.preset': found \"Steel\"", "expected",
                 {"material.glass.preset=\"Steel\""});
  // Values of the preset that contradict the scene's.
  require_faults("preset = \"soda-lime, paper\"\npoisson = 0.45\n", 1,
                 "s.toml:24:11: key 'material.glass.poisson'", "");
  const std::string law =
      "[material.glass.johnson_holmquist]\nA = 1\nN = 1\nB = 1\nM = 1\nT = 1e8\nHEL = 5e9\nPHEL = 3e9\nD1 = "
      "0.1\nD2 = 1\n";
  require_faults("preset = \"soda-lime, paper\"\n" + law, 3, "s.toml:23:10: key 'material.glass.d",
                 "found together with 'johnson_holmquist'");
  require_faults(elastic + law, 3, "--set 1: key 'material.glass.d",
                 "found together with 'johnson_holmquist'", {"material.glass.preset=\"soda-lime, paper\""});
}
