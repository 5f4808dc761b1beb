#include "output/result_file.hpp"

#include <sys/fsuid.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

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
    CHECK(reader.step_index(s) == expected.step_index);
    for (const Field& field : expected.fields) {
      const Field found = reader.field(s, field.name);
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

/// No protection stops root: as long as it lives, files are opened and made as "nobody" does, whose
/// `directory` then is.
class AsNobody {
 public:
  explicit AsNobody(const std::filesystem::path& directory) {
    constexpr unsigned nobody = 65534;
    if (!root_) return;
    REQUIRE(chown(directory.c_str(), nobody, nobody) == 0);
    setfsuid(nobody);
  }
  ~AsNobody() {
    if (root_) setfsuid(0);
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  bool root_ = geteuid() == 0;
};

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
    CHECK(result.steps().size() == 4);
    CHECK(result.particles() == 3);
    result.close();
  }
  CHECK_FALSE(std::filesystem::exists(next_of(result_path(directory.path()))));
  check_complete(directory.path(), 4);

  const File file = File::open_to_read(result_path(directory.path()));
  const Group& root = file.root();
  const RunHeader header = sample_header();
  CHECK(root.names() ==
        std::vector<std::string>{"bodies", "particles", "provenance", "scene", "series", "steps"});
  CHECK(root.open_group("series").names() == std::vector<std::string>{"kinetic", "step_index", "time"});
  CHECK(root.open_group("series").text_attribute("time", "unit") == "s");
  CHECK(root.open_group("steps").names() == std::vector<std::string>{"00000", "00001", "00002", "00003"});
  CHECK(root.extent("steps/00000/particles/position").columns == 2);
  CHECK(root.read_text("scene/verbatim") == header.scene_verbatim);
  CHECK(root.read_text("scene/resolved") == header.scene_resolved);
  CHECK(root.text_attribute(".", "title") == header.title);
  CHECK(root.text_attribute("provenance", "command") == header.provenance.command);
  CHECK(root.read_indices("particles/body") == header.particles.body);
  CHECK(root.read_doubles("particles/mass") == header.particles.mass);
  CHECK(root.text_attribute("particles/mass", "unit") == "kg");
  CHECK(root.read_texts("bodies") == header.particles.bodies);
}

TEST_CASE("The shadow is brought level to the byte", "[output]") {
  const TemporaryDirectory directory;
  constexpr std::size_t particles = 2000;
  RunHeader header = sample_header();
  header.particles.body.assign(particles, 0);
  header.particles.mass.assign(particles, 1.0);
  ResultFile result = ResultFile::create(directory.path(), header);
  std::string before;
  for (std::size_t s = 0; s < 200; ++s) {  // more rows than a chunk of a series has
    OutputFrame frame = sample_frame(s, particles);
    if (s % 3 == 1) frame.fields.clear();
    if (s > 50) frame.series.push_back({"late", "m", "begins late", 7.0});
    result.append(frame);
    if (s > 0) REQUIRE(bytes_of(next_of(result_path(directory.path()))) == before);
    before = bytes_of(result_path(directory.path()));
  }
}

TEST_CASE("What another program adds to a result between two outputs is kept", "[output]") {
  const TemporaryDirectory directory;
  ResultFile result = ResultFile::create(directory.path(), sample_header());
  for (std::size_t s = 0; s < 6; ++s) {
    result.append(sample_frame(s));
    if (s != 2) continue;
    File file = File::open_to_write(result_path(directory.path()));
    file.root().set_attribute(".", "note", std::string("a plate like last year's"));
    file.close();
  }
  check_complete(directory.path(), 6);
  const File file = File::open_to_read(result_path(directory.path()));
  CHECK(file.root().text_attribute(".", "note") == "a plate like last year's");
}

TEST_CASE("What another program changes in a file that an output has just replaced harms no result",
          "[output]") {
  const TemporaryDirectory directory;
  ResultFile result = ResultFile::create(directory.path(), sample_header());
  for (std::size_t s = 0; s < 6; ++s) {
    result.append(sample_frame(s));
    check_complete(directory.path(), s + 1);
    if (s == 0 || s == 4) continue;
    // It has opened result.h5 before the output, and goes on with what is the shadow now.
    File file = File::open_to_write(next_of(result_path(directory.path())));
    for (int n = 0; n < 40; ++n)
      file.root().set_attribute(".", "note " + std::to_string(n), std::string(500, 'x'));
    file.close();
  }
}

TEST_CASE("A result that was replaced by an older one is an error, not a gap", "[output]") {
  const TemporaryDirectory directory;
  const std::filesystem::path path = result_path(directory.path()), older = directory.path() / "older.h5";
  ResultFile result = ResultFile::create(directory.path(), sample_header());
  for (std::size_t s = 0; s < 3; ++s) {
    if (s == 2) std::filesystem::copy_file(path, older);
    result.append(sample_frame(s));
  }
  std::filesystem::rename(older, path);
  for (int attempt = 0; attempt < 2; ++attempt)
    CHECK_THROWS_WITH(result.append(sample_frame(3)),
                      contains_text("holds 2 outputs, but this run has written 3"));
  check_complete(directory.path(), 2);
}

TEST_CASE("A result that is write-protected or that others read goes on, one that others write does not",
          "[output]") {
  const TemporaryDirectory directory;
  const std::filesystem::path path = result_path(directory.path());
  const AsNobody not_root(directory.path());
  ResultFile result = ResultFile::create(directory.path(), sample_header());
  for (std::size_t s = 0; s < 6; ++s) {
    result.append(sample_frame(s));
    using std::filesystem::perms;
    if (s == 1) std::filesystem::permissions(path, perms::owner_read | perms::group_read);
  }
  {
    const File reader = File::open_to_read(path);
    result.append(sample_frame(6));
  }
  {
    File writer = File::open_to_write(path);
    CHECK_THROWS_WITH(result.append(sample_frame(7)),
                      contains_text("result.h5: another program has it open for writing"));
    writer.close();
  }
  result.append(sample_frame(7));
  check_complete(directory.path(), 8);
}

TEST_CASE("Without exchange of names the shadow is renamed", "[output]") {
  const TemporaryDirectory directory;
  ResultFile result = ResultFile::create(directory.path(), sample_header(), ResultFile::Publishing::replace);
  for (std::size_t s = 0; s < 3; ++s) result.append(sample_frame(s));
  check_complete(directory.path(), 3);
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
  CHECK(reader.steps()[2].fields.empty());
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
  ResultFile result = ResultFile::reopen(directory.path(), kept);
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
  CHECK(reader.field(1, "damage").values == sample_frame(1).fields[1].values);
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
    exit(result.steps().size() == 2 ? 0 : 2);  // through HDF5's own clean-up
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  check_complete(directory.path(), 2);
}
