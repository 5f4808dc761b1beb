#include "malformed_input.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

const std::string steel_keys =
    "[material.steel.von_mises]\nyield = 359e6\npeak = 484e6\nhardening = 9.6e9\nsoftening = 9.6e9\n";

std::vector<std::string> faults_of(const std::string& table) {
  return faults([&] { parse_scene(with(scene_text, steel_keys, table), "s.toml", {}); });
}
void require_fault(const std::string& table, std::string_view start, std::string_view part) {
  const std::vector<std::string> messages = faults_of(table);
  for (const std::string& message : messages) UNSCOPED_INFO(message);
  REQUIRE(messages.size() == 1);
  CHECK(messages[0].starts_with(start));
  CHECK(messages[0].find(part) != std::string::npos);
}

const std::string johnson_cook =
    "[material.steel.johnson_cook]\nA = 792e6\nB = 510e6\nn = 0.26\nm = 1.03\nmelting_temperature = "
    "1793\nheat_capacity = 477\n";
const std::string johnson_holmquist =
    "[material.steel.johnson_holmquist]\nA = 0.9\nN = 0.8\nB = 0.1\nM = 0.3\nT = 0.15e9\nHEL = 6e9\nPHEL = "
    "3e9\nD1 = 0.05\nD2 = 0.8\n";

}  // namespace

TEST_CASE("Laws: a law's table is read, and stands alone in its material", "[scene][laws]") {
  CHECK(faults_of(johnson_cook).empty());
  CHECK(faults_of(johnson_holmquist).empty());
  CHECK(faults_of("[material.steel.maxwell]\nratios = [0.5, 0.4]\ntimes = [1e-6, 1.0]\n").empty());
  require_fault(johnson_cook + steel_keys, "s.toml:41:1: key 'material.steel.von_mises'",
                "found together with 'johnson_cook'");
  require_fault(johnson_cook + johnson_holmquist, "s.toml:34:1: key 'material.steel.johnson_cook'",
                "found together with 'johnson_holmquist'");
}

TEST_CASE("Laws: values that contradict each other", "[scene][laws]") {
  require_fault(with(johnson_cook, "= 1793", "= 273"),
                "s.toml:39:23: key 'material.steel.johnson_cook.melting_temperature'",
                "expected more than reference_temperature (298 K)");
  require_fault(with(johnson_holmquist, "PHEL = 3e9", "PHEL = 7e9"),
                "s.toml:41:8: key 'material.steel.johnson_holmquist.PHEL'", "expected less than HEL");
  require_fault(johnson_holmquist + "K2 = -138e9\n", "s.toml:44:6: key 'material.steel.johnson_holmquist.K2'",
                "pressure rises");
  const std::string maxwell = "[material.steel.maxwell]\n";
  require_fault(maxwell + "ratios = [0.5, 0.4]\ntimes = [1.0]\n",
                "s.toml:36:9: key 'material.steel.maxwell.times'",
                "expected as many numbers as `ratios` has (2)");
  require_fault(maxwell + "ratios = [0.5, 0.6]\ntimes = [1.0, 2.0]\n",
                "s.toml:35:10: key 'material.steel.maxwell.ratios'", "at most 1");
  require_fault(maxwell + "ratios = []\ntimes = [1.0]\n", "s.toml:35:10: key 'material.steel.maxwell.ratios'",
                "");
  require_fault(maxwell + "ratios = [0.5]\ntimes = [0.0]\n",
                "s.toml:36:10: key 'material.steel.maxwell.times", "0");
  require_fault(maxwell + "ratios = [0.5]\ntimes = [1.0]\nC1 = 17\ntemperature = 200\n",
                "s.toml:38:15: key 'material.steel.maxwell.temperature'",
                "expected more than reference_temperature - C2");
}
