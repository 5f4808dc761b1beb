#include "output/info.hpp"
#include "materials/registry.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "contains_text.hpp"
#include "output/atomic_file.hpp"
#include "output/hdf5.hpp"
#include "output/provenance.hpp"
#include "output/reference_page.hpp"
#include "output/result_file.hpp"
#include "sample_run.hpp"
#include "scene/input_error.hpp"
#include "temporary_directory.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::output;

namespace {
void write_sample(const std::filesystem::path& directory) {
  ResultFile result = ResultFile::create(directory, sample_header());
  for (std::size_t s = 0; s < 3; ++s) result.append(sample_frame(s));
}
}  // namespace

TEST_CASE("info describes a result as text and as JSON", "[output]") {
  const TemporaryDirectory directory;
  write_sample(directory.path());
  CHECK_THAT(describe_result(directory.path(), false),
             contains_text("∅ 1 cm") && contains_text("killed, or under way") && contains_text("plate") &&
                 contains_text("outputs (3)") && contains_text("position") &&
                 contains_text("kinetic energy") && contains_text("vitrum run 'a b.toml'"));
  std::ofstream(directory.path() / "summary.json") << R"({"status": "failed", "message": "why"})";
  const auto json = nlohmann::json::parse(describe_result(directory.path(), true));
  CHECK(json["summary"]["status"] == "failed");
  CHECK(json["outputs"].size() == 3);
  CHECK(json["outputs"][2]["time"] == 2.0e-6);
  CHECK(json["bodies"]["plate"] == 2);
  CHECK(json["fields"]["position"]["components"] == 2);
  CHECK(json["series"]["kinetic"]["last"] == 2000.25);
  CHECK(json["provenance"]["scene_sha256"] == "00ff");
  CHECK_FALSE(
      nlohmann::json::parse(describe_result(result_path(directory.path()), true)).contains("summary"));
  std::ofstream(directory.path() / "summary.json") << "{";
  CHECK_THROWS_WITH(describe_result(directory.path(), true), contains_text("is not a summary"));
}

TEST_CASE("info refuses what is no result", "[output]") {
  const TemporaryDirectory directory;
  CHECK_THROWS_AS(describe_result(directory.path(), false), FileError);
  CHECK_THROWS_AS(describe_result(directory.path() / "absent.h5", false), FileError);
  std::ofstream(directory.path() / "text.h5") << "text";
  CHECK_THROWS_WITH(describe_result(directory.path() / "text.h5", false),
                    contains_text("cannot open the file as HDF5"));
  File foreign = File::create(directory.path() / "foreign.h5");
  const std::span<char> bytes = foreign.close();
  put_in_place(directory.path() / "foreign.h5", {bytes.data(), bytes.size()});
  CHECK_THROWS_WITH(describe_result(directory.path() / "foreign.h5", false),
                    contains_text("is not a vitrum result"));
}

TEST_CASE("Truncated and altered results give errors or descriptions, never a crash", "[output]") {
  const TemporaryDirectory directory;
  write_sample(directory.path());
  std::ifstream file(result_path(directory.path()), std::ios::binary);
  const std::string intact{std::istreambuf_iterator<char>(file), {}};
  const auto path = directory.path() / "broken.h5";
  const auto survives = [&path](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    const pid_t child = fork();
    if (child == 0) {
      alarm(2);
      try {
        describe_result(path, true);
      } catch (const FileError&) {
      }
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  };
  for (std::size_t length = 0; length < intact.size(); length += 1 + intact.size() / 20)
    CHECK(survives(intact.substr(0, length)));
  // HDF5 1.10 can loop for ever over a damaged heap of texts, which has no checksum: those 4 KiB blocks are
  // left alone here.
  const auto in_text_heap = [&intact](std::size_t position) {
    const std::size_t heap = intact.rfind("GCOL", position);
    return heap != std::string::npos && position < heap + 4096;
  };
  for (std::size_t position = 0; position < intact.size(); position += 1 + intact.size() / 150) {
    if (in_text_heap(position)) continue;
    std::string altered = intact;
    altered[position] = static_cast<char>(altered[position] ^ 0x55);
    INFO("byte " << position);
    CHECK(survives(altered));
  }
}

TEST_CASE("Provenance and versions are complete", "[output]") {
  const Provenance provenance = make_provenance("vitrum run x", "ff");
  for (const ProvenanceEntry& entry : provenance_entries) CHECK_FALSE((provenance.*entry.member).empty());
  CHECK(provenance.started.size() == 20);
  CHECK(provenance.started.back() == 'Z');
  CHECK_THAT(version_text(), contains_text("vitrum ") && contains_text("SUNDIALS") && contains_text("KLU") &&
                                 contains_text("Eigen") && contains_text("HDF5") && contains_text("toml++") &&
                                 contains_text("fmt"));
}

TEST_CASE("The result reference lists every variable", "[output]") {
  for (const Component& column : all_columns())
    CHECK_THAT(result_reference(), contains_text("| `" + column.name + "` | 1 |"));
}
