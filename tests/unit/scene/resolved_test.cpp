#include <cmath>
#include <filesystem>
#include <fstream>

#include "malformed_input.hpp"
#include "scene/reference_page.hpp"
#include "scene/scene_tables.hpp"
#include "scene/toml_text.hpp"
#include "scene/write_scene.hpp"
#include "scene/write_table.hpp"
#include "vitrum_source_dir.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

void require_round_trip(const Scene& scene) {
  const std::string text = resolved_toml(scene);
  INFO(text);
  CHECK(resolved_toml(parse_scene(text, "resolved")) == text);
}

Scene reference() {
  return read_scene(std::filesystem::path(VITRUM_SOURCE_DIR) / "studies/paper/reference.toml");
}

}  // namespace

TEST_CASE("resolved scenes read back as the same scene", "[scene]") {
  require_round_trip(parse_scene(scene_text, "s.toml"));
  require_round_trip(reference());
  require_round_trip(parse_scene(
      scene_text, "s.toml",
      {"title=\"a \\\"quote\\\", a \\\\ and \\u0001 é\"", "integrator.max_growth=inf",
       "integrator.courant=0.1", "integrator.table=\"ARKODE_KVAERNO_4_2_3\"", "integrator.max_step=1e-6",
       "output.fields=[\"velocity\", \"damage\"]", "output.every=0.1",
       "material.glass.damage.rate={fixed=1e3}",
       "material.glass.decohesion={opening=5e-6, mode_ratio=50, plane=\"all\"}",
       "material.glass.drucker_prager={yield=43e6, beta=1.8, flow=\"associated\"}",
       "body.1.stress=[1, -2, 3e-310, 0.1]",
       "body.1.velocity_gradient=[[0.1, 0.30000000000000004], [1e22, -0.0]]", "body.1.particles_per_cell=9",
       "space.cell=123456789012345680000.0", "material.\"odd name\"={density=1, young=2, poisson=-0.5}"}));
  require_round_trip(
      parse_scene(with(with(scene_text, "\"axisymmetric\"", "\"plane-strain\""), "[\"r\", \"z\"]", "[\"y\"]"),
                  "s.toml", {"boundary.0.velocity=[0, 3]"}));
  const std::string_view disk = "disk = {centre = [0, 0.01], radius = 0.004}";
  require_round_trip(
      parse_scene(with(scene_text, disk, "ring = {centre = [1, 2], inner = 0, outer = 0.3}"), "s.toml"));
  require_round_trip(
      parse_scene(with(scene_text, disk, "polygon = [[0, 1], [1, 1], [0.5, 1.1], [1, 2]]"), "s.toml"));
}

TEST_CASE("no line end of any kind is left in a single line", "[scene]") {
  const std::string text =
      "a\nb\x7f"
      "c\xc2\x85"
      "d\xe2\x80\xa8"
      "e\xe2\x80\xa9"
      "\xc3\xa9\xe2\x80\xa6\xc2";
  CHECK(scene::single_line(text) == "a b c d e \xc3\xa9\xe2\x80\xa6\xc2");
  CHECK(scene::has_control_characters(text));
  CHECK(!scene::has_control_characters("\xc3\xa9\xe2\x80\xa6\xc2"));
  CHECK(scene::toml_quoted(text) == "\"a\\nb\\u007Fc\\u0085d\\u2028e\\u2029\xc3\xa9\xe2\x80\xa6\xc2\"");
}

TEST_CASE("numbers are written so that they read back bit for bit, as floats", "[scene]") {
  CHECK(scene::number_text(0.2) == "0.2");
  CHECK(scene::number_text(3.0) == "3.0");
  CHECK(scene::number_text(-0.0) == "-0.0");
  CHECK(scene::number_text(123456789012345680000.0) == "123456789012345683968.0");  // not a TOML integer
  CHECK(scene::number_text(-INFINITY) == "-inf");
}

TEST_CASE("defaults", "[scene]") {
  const Scene scene = parse_scene(with(scene_text, "step = 1.0e-7", ""), "s.toml");
  CHECK(scene.integrator.courant == 0.4);
  CHECK_FALSE(scene.integrator.step);
  CHECK(scene.integrator.max_growth == 1.5);
  CHECK(scene.start == 0.0);
  CHECK(scene.bodies[0].particles_per_cell == 1);
  CHECK(scene.materials[0].damage->rate_floor == 1.0);
  CHECK(scene.materials[0].damage->fixed_rate == 0.0);
  CHECK_FALSE(scene.output.every);
  CHECK_FALSE(scene.output.fields);
}

namespace {

/// Gives every default of a table, and of those below it, whose keys stand at `path` of the resolved scene
/// `base`.
void give_defaults(const schema::Table& table, const std::string& path, const std::string& base, int& given) {
  for (const schema::Key& key : table.keys) {
    const bool in_list = key.shape.kind == schema::Kind::tables;
    const std::string at = path + key.name;
    if (key.fallback) {
      const std::string override = at + '=' + scene::value_text(*key.fallback);
      INFO(override);
      CHECK(resolved_toml(parse_scene(base, "s.toml", {override})) == base);
      ++given;
    }
    if (key.table == nullptr || key.table->in_one_line) continue;
    const std::string table_path = at + (key.name == "material" ? ".glass" : "");
    if (base.find('[' + table_path + ']') != std::string::npos)  // of the tables that there are
      give_defaults(*key.table, table_path + (in_list ? ".0." : "."), base, given);
  }
}

}  // namespace

TEST_CASE("giving a documented default changes nothing", "[scene]") {
  const Scene base = parse_scene(
      with(with(scene_text, "step = 1.0e-7", ""), "title = \"test\"", ""), "s.toml",
      {"material.glass.decohesion={opening=1, mode_ratio=1}",
       "material.glass.drucker_prager={yield=1, beta=1}", "material.steel=none", "body.1.material=\"glass\"",
       "boundary.0.name=\"wall\"", "body.1.velocity=none", "contact={}"});
  int given = 0;
  give_defaults(scene::scene_table(base.geometry), "", resolved_toml(base), given);
  CHECK(given >= 25);
}

TEST_CASE("materials keep the order of the file", "[scene]") {
  const Scene scene =
      parse_scene(with(scene_text, "[material.glass]",
                       "[material.zinc]\ndensity = 1\nyoung = 1\npoisson = 0\n[material.glass]"),
                  "s");
  REQUIRE(scene.materials.size() == 3);
  CHECK(scene.materials[0].name == "zinc");
  CHECK(scene.materials[1].name == "glass");
}

TEST_CASE("the paper's reference case", "[scene]") {
  const Scene scene = reference();
  REQUIRE(scene.bodies.size() == 2);
  CHECK(scene.bodies[0].name == "plate");
  CHECK(scene.bodies[1].name == "cylinder");
  CHECK(scene.start == -15.0e-6);
  CHECK(scene.end == 150.0e-6);
  CHECK(scene.integrator.step == 0.2e-6);
  CHECK(scene.output.every == 10.0e-6);
  CHECK(std::get<Box>(scene.bodies[1].shape).min == Vector2{0.0, 0.008});
  CHECK(std::get<Box>(scene.bodies[1].shape).max == Vector2{0.005, 0.058});
  REQUIRE(scene.boundaries.size() == 1);
  CHECK(scene.boundaries[0].fixed == std::array<bool, 2>{true, true});
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0].damage->toughness == 0.83e6);
  CHECK(scene.materials[0].drucker_prager->beta == 1.8);
  CHECK(scene.materials[0].decohesion->mode_ratio == 50.0);
  CHECK(scene.materials[1].von_mises->peak == 484.0e6);
  CHECK(scene.materials[1].decohesion->opening == 1.6e-9);
}

TEST_CASE("files that cannot be used", "[scene]") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  CHECK_THROWS_AS(read_scene(folder / "vitrum-no-such-scene.toml"), InputError);
  CHECK_THROWS_AS(read_scene(folder), InputError);
  const std::filesystem::path file = folder / "vitrum-unreadable-scene.toml";
  std::ofstream(file) << scene_text;
  std::filesystem::permissions(file, std::filesystem::perms::none);
  // The superuser reads any file: then there is nothing to see here.
  if (!std::ifstream(file)) CHECK_THROWS_AS(read_scene(file), FileError);
  std::filesystem::remove(file);
}

TEST_CASE("the reference page names every key", "[scene]") {
  const std::string page = scene_reference();
  for (const std::string_view part : {"`[space]`", "`max_growth`", "`[material.NAME.decohesion]`",
                                      "| `toughness` | a number > 0 (Pa m^0.5) | required |",
                                      "| `samples` | an integer from 1 to 1000000 | `200` |"})
    CHECK(page.find(part) != std::string::npos);
}
