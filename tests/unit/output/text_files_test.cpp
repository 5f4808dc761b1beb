#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "contains_text.hpp"
#include "output/atomic_file.hpp"
#include "output/csv_file.hpp"
#include "output/result_file.hpp"
#include "output/summary.hpp"
#include "output/xdmf.hpp"
#include "sample_run.hpp"
#include "scene/input_error.hpp"
#include "temporary_directory.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::output;

namespace {
std::string content(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}
constexpr double not_finite = std::numeric_limits<double>::infinity();
}  // namespace

TEST_CASE("Text is written as a whole or not at all", "[output]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "text";
  write_text_atomically(path, "one");
  write_text_atomically(path, "");
  CHECK(content(path).empty());
  CHECK(std::distance(std::filesystem::directory_iterator(directory.path()), {}) == 1);
  CHECK_THROWS_WITH(write_text_atomically(directory.path() / "absent" / "text", "x"),
                    contains_text("No such file or directory"));
  std::filesystem::create_directory(directory.path() / "taken");
  CHECK_THROWS_WITH(write_text_atomically(directory.path() / "taken", "x"), contains_text("cannot replace"));
}

TEST_CASE("A table's file grows by whole lines, and is cut back to where it is continued", "[output]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "energy.csv";
  std::uint64_t two_rows = 0;
  {
    CsvFile csv = CsvFile::create(path, "time,kinetic");
    csv.append("0,4\n0.1,5\n");
    two_rows = csv.size();
    csv.append("0.2,6\n");
    CHECK(content(path) == "time,kinetic\n0,4\n0.1,5\n0.2,6\n");
  }
  std::ofstream(path, std::ios::app) << "0.3,";  // cut off by a kill
  CHECK_THROWS_WITH(CsvFile::reopen(path, "time,kinetic", 100), contains_text("fewer than the 100"));
  CHECK_THROWS_WITH(CsvFile::reopen(path, "time,kinetic", two_rows - 1),
                    contains_text("no line ends at byte"));
  CHECK_THROWS_WITH(CsvFile::reopen(path, "time,kinetic", 0), contains_text("no line ends at byte"));
  CHECK_THROWS_WITH(CsvFile::reopen(path, "time,elastic", two_rows), contains_text("first line is not"));
  CsvFile csv = CsvFile::reopen(path, "time,kinetic", two_rows);
  csv.append("0.2,7\n");
  CHECK(content(path) == "time,kinetic\n0,4\n0.1,5\n0.2,7\n");
  CHECK_THROWS_AS(CsvFile::create(directory.path() / "absent" / "energy.csv", "a"), FileError);
}

TEST_CASE("The summary says null where nothing happened", "[output]") {
  const TemporaryDirectory directory;
  RunSummary summary;
  summary.energy.kinetic = not_finite;
  BodySummary plate{"plate", 3, 1.5, {0.0, not_finite}, {0.1, 0.2}, 7.0, {}};
  plate.failure.localised = 1;
  plate.failure.separated = 2;
  summary.bodies.push_back(plate);
  const nlohmann::ordered_json json = to_json(summary);
  for (const char* key :
       {"status", "message", "time", "particles", "wall_seconds", "total_seconds", "threads", "integrator",
        "constitutive", "energy", "failure", "bodies", "provenance"})
    CHECK(json.contains(key));
  CHECK(json["status"] == "complete");
  CHECK(json["message"].is_null());
  CHECK(json["integrator"]["step_min"].is_null());
  CHECK(json["energy"]["kinetic"].is_null());
  CHECK(json["failure"]["first_damage"].is_null());
  CHECK(json["failure"]["perforated"].is_null());
  CHECK(json["failure"]["damage_threshold"] == 0.001);
  CHECK(json["failure"]["fragments"]["largest_mass"].is_null());
  CHECK(json["bodies"]["plate"]["momentum"][1].is_null());
  CHECK(json["bodies"]["plate"]["separated"] == 2);
  CHECK(json["provenance"].size() == 8);
  summary.provenance.command = "vitrum run \xff.toml";
  write_summary(directory.path() / "summary.json", summary);
  CHECK(nlohmann::ordered_json::parse(content(directory.path() / "summary.json"))["failure"] ==
        json["failure"]);
}

TEST_CASE("The summary reports what happened and lists the largest fragments", "[output]") {
  RunSummary summary;
  summary.status = RunStatus::failed;
  summary.message = "energy grew";
  summary.integrator.steps = 1;
  summary.integrator.step_min = 1e-8;
  summary.failure.first_separation = FirstEvent{1e-6, 0.1, 0.2, "plate"};
  summary.failure.perforated = false;
  for (int f = 150; f > 0; --f)
    summary.failure.fragments.push_back({"plate", 1, 1.0 * f, {0.0, 1.0}, {2.0, 3.0}});
  const nlohmann::ordered_json json = to_json(summary);
  CHECK(json["status"] == "failed");
  CHECK(json["message"] == "energy grew");
  CHECK(json["integrator"]["step_min"] == 1e-8);
  CHECK(json["failure"]["first_separation"]["body"] == "plate");
  CHECK(json["failure"]["perforated"] == false);
  const auto& fragments = json["failure"]["fragments"];
  CHECK(fragments["count"] == 150);
  CHECK(fragments["largest_mass"] == 150.0);
  CHECK(fragments["total_mass"] == 150.0 * 151.0 / 2.0);
  CHECK(fragments["list"].size() == 100);
  CHECK(fragments["list"][99]["mass"] == 51.0);
  CHECK(fragments["list"][0]["velocity"][1] == 3.0);
}

TEST_CASE("result.xdmf includes the outputs that can be drawn, and those name their blocks and fields",
          "[output]") {
  const TemporaryDirectory directory;
  RunHeader header = sample_header();
  header.particles.bodies[0] = "a <\"plate\"> & co";
  ResultFile result = ResultFile::create(directory.path(), header);
  OutputFrame bare = sample_frame(1);
  bare.fields.clear();
  result.append(sample_frame(0));
  result.append(bare);
  result.append(sample_frame(2));
  CHECK_THAT(content(directory.path() / "result.xdmf"), contains_text("href=\"steps/00000.xmf\"") &&
                                                            contains_text("href=\"steps/00002.xmf\"") &&
                                                            !contains_text("00001"));
  CHECK_FALSE(std::filesystem::exists(step_xdmf_path(directory.path(), 1)));
  CHECK_THAT(content(step_xdmf_path(directory.path(), 2)),
             contains_text("<Time Value=\"2e-06\"/>") &&
                 contains_text("<Grid Name=\"a &lt;&quot;plate&quot;> &amp; co\"") &&
                 contains_text("steps/00002.h5:/drawn/1/position") &&
                 contains_text("steps/particles.h5:/drawn/1/mass") &&
                 contains_text("<Attribute Name=\"damage\" AttributeType=\"Scalar\" Center=\"Node\">") &&
                 contains_text("Dimensions=\"2 2\""));
}

TEST_CASE("What is drawn: vectors of three, tensors in the order of VTK, and invariants of stress",
          "[output]") {
  const ParticleConstants constants{{"a", "b"}, {0, 1, 1}, {1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}, "kg"};
  const Field position{"position", "m", "", 2, {0, 1, 2, 3, 4, 5}},
      velocity{"velocity", "m/s", "", 2, {0, 1, 2, 3, 4, 5}},
      stress{"stress", "Pa", "", 4, {1, 2, 3, 4, 5, 5, 5, 0, 0, 0, 0, 2}},
      r{"normal_r", "1", "", 1, {1, 0, 0.6}}, z{"normal_z", "1", "", 1, {0, 1, 0.8}};
  const OutputFrame frame{0.0, 0, {position, velocity, stress, r, z}, {}, {0, -1, 0}};
  const std::vector<DrawnBody> bodies = drawing(frame, constants);
  REQUIRE(bodies.size() == 2);
  CHECK(bodies[1].name == "b");
  CHECK(bodies[1].particles == 2);
  const auto values = [&](const std::string& name) {
    for (const DrawnArray& array : bodies[1].arrays)
      if (array.name == name) return array.values;
    return std::vector<double>{-77.0};
  };
  CHECK(values("position") == std::vector<double>{2, 3, 4, 5});
  CHECK(values("velocity") == std::vector<double>{2, 3, 0, 4, 5, 0});
  CHECK(values("stress") == std::vector<double>{5, 5, 5, 0, 0, 0, 0, 0, 0, 2, 0, 0});
  CHECK(values("normal") == std::vector<double>{0, 1, 0, 0.6, 0.8, 0});
  CHECK(values("normal_r") == std::vector<double>{-77.0});
  CHECK(values("pressure") == std::vector<double>{-5, 0});
  CHECK(values("von_mises") == std::vector<double>{0, std::sqrt(12.0)});
  CHECK(values("mass") == std::vector<double>{2, 3});
  CHECK(values("size") == std::vector<double>{0.2, 0.3});
  CHECK(values("fragment") == std::vector<double>{-1, 0});
  CHECK(drawing({0.0, 0, {velocity}, {}, {}}, constants).empty());
}
