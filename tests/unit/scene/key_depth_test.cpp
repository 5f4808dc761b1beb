#include "scene/key_depth.hpp"

#include <string>

#include "scene/read_scene.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::scene;

namespace {

std::string dotted(std::size_t parts, const std::string& part = "a", const std::string& dot = ".") {
  std::string key = part;
  for (std::size_t i = 1; i < parts; ++i) key += dot + part;
  return key;
}

}  // namespace

TEST_CASE("Keys of too many parts are found wherever TOML admits keys, and nothing else is", "[scene]") {
  for (const std::string& key : {dotted(65), dotted(65, "\"a.b\""), dotted(65, "'#'", " . ")}) {
    for (const std::string& text :
         {key + " = 1", "[" + key + "]", "x = {y = 1, " + key + " = 1}", "x = \"#\"\n" + key + "=1"})
      CHECK(find_deep_key(text));
  }
  for (const std::string& text :
       {dotted(64) + " = 1", "title = \"" + dotted(200) + "\"", "title = '" + dotted(200) + "'",
        "title = \"\"\"\n" + dotted(200) + "\n\"\"\"", "title = '''" + dotted(200) + "'''",
        "# " + dotted(200), "x = [" + dotted(200, "1", ".5, ") + "]", "title = \"\\\"" + dotted(200) + "\"",
        std::string("'"), std::string("\"\"\""), std::string("#"), std::string()})
    CHECK_FALSE(find_deep_key(text));
  const auto place = find_deep_key("title = \"x\"\n  " + dotted(65) + " = 1");
  REQUIRE(place);
  CHECK(place->line == 2);
  CHECK(place->column == 2 + 2 * 64);
}

TEST_CASE("Keys of a hundred thousand parts are refused, not recursed into", "[scene]") {
  const std::string key = dotted(100000);
  CHECK_THROWS_AS(parse_scene(key + " = 1", "deep.toml"), InputError);
  CHECK_THROWS_AS(parse_scene("[" + key + "]", "deep.toml"), InputError);
  CHECK_THROWS_AS(parse_scene("", "deep.toml", {key + "=1"}), InputError);
  CHECK_THROWS_AS(parse_scene("", "deep.toml", {"x={" + key + "=1}"}), InputError);
}
