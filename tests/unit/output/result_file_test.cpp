#include "output/result_file.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>

#include "contains_text.hpp"
#include "output/atomic_file.hpp"
#include "output/result_reader.hpp"
#include "sample_run.hpp"
#include "temporary_directory.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::output;

namespace {

void check_complete(const std::filesystem::path& directory, std::size_t outputs) {
  const ResultReader reader(directory);
  REQUIRE(reader.steps().size() == outputs);
  for (std::size_t s = 0; s < outputs; ++s) {
    const OutputFrame expected = sample_frame(s);
    CHECK(reader.steps()[s].time == expected.time);
    CHECK(reader.steps()[s].step_index == expected.step_index);
    const OutputReader output = reader.output(s);
    for (const Field& field : expected.fields) {
      const Field found = output.field(field.name);
      CHECK(found.values == field.values);
      CHECK(found.components == field.components);
      CHECK(found.unit == field.unit);
      CHECK(found.description == field.description);
    }
  }
  for (const StoredSeries& series : reader.series()) {
    REQUIRE(series.values.size() == outputs);
    for (std::size_t s = 0; s < outputs && series.name == "kinetic"; ++s)
      CHECK(series.values[s] == sample_frame(s).series[0].value);
  }
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("A result file has the documented layout", "[output]") {
  const TemporaryDirectory directory;
  {
    ResultFile result = ResultFile::create(directory.path(), sample_header());
    for (std::size_t s = 0; s < 4; ++s) result.append(sample_frame(s));
    CHECK(result.outputs() == 4);
    CHECK(result.particles() == 3);
    result.settle();
  }
  CHECK_FALSE(std::filesystem::exists(next_of(result_path(directory.path()))));
  check_complete(directory.path(), 4);

  const File file = File::open_to_read(result_path(directory.path()));
  const Group& root = file.root();
  const RunHeader header = sample_header();
  CHECK(root.names() == std::vector<std::string>{"bodies", "events", "particles", "provenance", "scene",
                                                 "series", "steps", "tables"});
  CHECK(root.open_group("series").names() == std::vector<std::string>{"kinetic", "step_index", "time"});
  CHECK(root.open_group("series").text_attribute("time", "unit") == "s");
  CHECK(root.open_group("steps").names() == std::vector<std::string>{"00000", "00001", "00002", "00003"});
  CHECK(File::open_to_read(step_path(directory.path(), 0)).root().extent("particles/position").columns == 2);
  CHECK(root.read_text("scene/verbatim") == header.scene_verbatim);
  CHECK(root.read_text("scene/resolved") == header.scene_resolved);
  CHECK(root.text_attribute(".", "title") == header.title);
  CHECK(root.text_attribute("provenance", "command") == header.provenance.command);
  const ParticleConstants constants = ResultReader(directory.path()).constants();
  CHECK(constants.body == header.particles.body);
  CHECK(constants.mass == header.particles.mass);
  CHECK(constants.size == header.particles.size);
  CHECK(constants.mass_unit == "kg");
  CHECK(root.read_texts("bodies") == header.particles.bodies);
}

TEST_CASE("An output writes its own files and the door, and those of earlier outputs stay as they are",
          "[output]") {
  const TemporaryDirectory directory;
  ResultFile result = ResultFile::create(directory.path(), sample_header());
  result.append(sample_frame(0));
  const std::string first = bytes_of(step_path(directory.path(), 0));
  const auto written = std::filesystem::last_write_time(step_path(directory.path(), 0));
  for (std::size_t s = 1; s < 200; ++s)
    result.append(sample_frame(s));  // more rows than a chunk of a series has
  result.settle();
  CHECK(bytes_of(step_path(directory.path(), 0)) == first);
  CHECK(std::filesystem::last_write_time(step_path(directory.path(), 0)) == written);
  check_complete(directory.path(), 200);
}

TEST_CASE("Beyond 64 outputs the door follows in groups, and settling closes up", "[output]") {
  const TemporaryDirectory directory;
  constexpr std::size_t outputs = 400;
  std::size_t renewals = 0, shown = 0;
  ResultFile result = ResultFile::create(directory.path(), sample_header());
  std::string before;
  for (std::size_t s = 0; s < outputs; ++s) {
    OutputFrame frame = sample_frame(s);
    frame.fields.clear();
    result.append(frame);
    if (std::string now = bytes_of(result_path(directory.path())); now != before)
      before = std::move(now), ++renewals, shown = s + 1;
    REQUIRE((s + 1 - shown) * 64 < s + 1);
  }
  CHECK(renewals < outputs);
  usleep(60000);
  result.append(sample_frame(outputs));
  CHECK(ResultReader(directory.path()).steps().size() == outputs + 1);
  result.append(sample_frame(outputs + 1));
  result.settle();
  CHECK(ResultReader(directory.path()).steps().size() == outputs + 2);
}

TEST_CASE("An output of another run in the place of one is an error", "[output]") {
  const TemporaryDirectory directory;
  ResultFile result = ResultFile::create(directory.path(), sample_header());
  for (std::size_t s = 0; s < 3; ++s) result.append(sample_frame(s));
  std::filesystem::copy_file(step_path(directory.path(), 2), step_path(directory.path(), 1),
                             std::filesystem::copy_options::overwrite_existing);
  const ResultReader reader(directory.path());
  CHECK_THROWS_WITH(reader.output(1), contains_text("00001.h5: is of another run"));
  CHECK_THROWS_AS(ResultFile::reopen(directory.path(), 3), FileError);
  std::filesystem::remove(step_path(directory.path(), 0));
  CHECK_THROWS_WITH(reader.output(0), contains_text("00000.h5: cannot open the file as HDF5: "));
}

TEST_CASE("Series may begin late, and frames may have no particles", "[output]") {
  const TemporaryDirectory directory;
  ResultFile result = ResultFile::create(directory.path(), sample_header());
  OutputFrame frame = sample_frame(0);
  frame.fields.clear();
  result.append(frame);
  frame.series.push_back({"late", "m", "begins late", 7.0});
  result.append(frame);
  result.append(frame);
  const ResultReader reader(directory.path());
  CHECK(reader.output(2).fields().empty());
  for (const StoredSeries& series : reader.series())
    if (series.name == "late") {
      REQUIRE(series.values.size() == 3);
      CHECK(std::isnan(series.values[0]));
      CHECK(series.values[2] == 7.0);
    }
}

TEST_CASE("A reopened result drops later outputs and goes on", "[output]") {
  const TemporaryDirectory directory;
  {
    ResultFile result = ResultFile::create(directory.path(), sample_header());
    for (std::size_t s = 0; s < 5; ++s) result.append(sample_frame(s));
  }
  const std::size_t kept = GENERATE(0U, 2U, 5U);
  std::ofstream(steps_path(directory.path()) / ".00004.h5.next") << "of a run that was killed";
  std::ofstream(steps_path(directory.path()) / "notes") << "kept";
  ResultFile result = ResultFile::reopen(directory.path(), kept);
  for (std::size_t s = 0; s < 6; ++s) {
    CHECK(std::filesystem::exists(step_path(directory.path(), s)) == (s < kept));
    CHECK(std::filesystem::exists(step_xdmf_path(directory.path(), s)) == (s < kept));
  }
  CHECK(std::filesystem::exists(steps_path(directory.path()) / ".00004.h5.next") == (kept == 5));
  CHECK(std::filesystem::exists(steps_path(directory.path()) / "notes"));
  check_complete(directory.path(), kept);
  for (std::size_t s = kept; s < 7; ++s) result.append(sample_frame(s));
  check_complete(directory.path(), 7);
  CHECK(ResultReader(directory.path()).title() == sample_header().title);
  CHECK_THROWS_WITH(ResultFile::reopen(directory.path(), 8),
                    contains_text("holds 7 outputs, fewer than the 8"));
}

TEST_CASE("A reader keeps the version it opened while the run goes on", "[output]") {
  const TemporaryDirectory directory;
  ResultFile result = ResultFile::create(directory.path(), sample_header());
  result.append(sample_frame(0));
  result.append(sample_frame(1));
  const ResultReader reader(directory.path());
  for (std::size_t s = 2; s < 6; ++s) result.append(sample_frame(s));
  CHECK(reader.steps().size() == 2);
  CHECK(reader.output(1).field("damage").values == sample_frame(1).fields[1].values);
  check_complete(directory.path(), 6);
}

TEST_CASE("A frame of the wrong size is refused", "[output]") {
  const TemporaryDirectory directory;
  ResultFile result = ResultFile::create(directory.path(), sample_header());
  CHECK_THROWS_AS(result.append(sample_frame(0, 4)), std::invalid_argument);
}

TEST_CASE("Directories that cannot be written give errors", "[output]") {
  const TemporaryDirectory directory;
  CHECK_THROWS_AS(ResultFile::create(directory.path() / "absent", sample_header()), FileError);
  std::ofstream(directory.path() / "file") << "x";
  CHECK_THROWS_AS(ResultFile::create(directory.path() / "file", sample_header()), FileError);
  CHECK_THROWS_AS(ResultFile::reopen(directory.path(), 0), FileError);
  std::filesystem::permissions(directory.path(),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  if (geteuid() != 0) CHECK_THROWS_AS(ResultFile::create(directory.path(), sample_header()), FileError);
  std::filesystem::permissions(directory.path(), std::filesystem::perms::owner_all);
}

TEST_CASE("When the disk is full the error is reported and the result is as before", "[output]") {
  const TemporaryDirectory directory;
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    // A limit on the size of files stands in for the full disk.
    const rlimit limit{std::size_t{1} << 20, std::size_t{1} << 20};
    std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
    ResultFile result = ResultFile::create(directory.path(), sample_header());
    result.append(sample_frame(0));
    OutputFrame large = sample_frame(1);
    large.series.clear();
    for (int s = 0; s < 4000; ++s)
      large.series.push_back({"series " + std::to_string(s), "1", "fills the disk", 0.0});
    for (int attempt = 0; attempt < 2; ++attempt) {
      try {
        result.append(large);
        _exit(1);
      } catch (const FileError&) {
      }
    }
    result.append(sample_frame(1));
    exit(result.outputs() == 2 ? 0 : 2);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  check_complete(directory.path(), 2);
}
