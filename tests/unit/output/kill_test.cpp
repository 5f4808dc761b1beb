#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>

#include "output/result_file.hpp"
#include "output/result_reader.hpp"
#include "sample_run.hpp"
#include "temporary_directory.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::output;

namespace {

constexpr std::size_t particles = 2000;

RunHeader header_of_many() {
  RunHeader header = sample_header();
  header.particles.body.assign(particles, 0);
  header.particles.mass.assign(particles, 1.0);
  header.particles.size.assign(particles, 1e-3);
  return header;
}

[[noreturn]] void write_until_killed(const std::filesystem::path& directory) {
  try {
    ResultFile result = ResultFile::create(directory, header_of_many());
    for (std::size_t s = 0;; ++s) result.append(sample_frame(s, particles));
  } catch (...) {
    _exit(1);
  }
}

useconds_t microseconds_of_outputs(std::size_t count) {
  const TemporaryDirectory directory;
  ResultFile result = ResultFile::create(directory.path(), header_of_many());
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t s = 0; s < count; ++s) result.append(sample_frame(s, particles));
  const auto taken = std::chrono::steady_clock::now() - start;
  return static_cast<useconds_t>(std::chrono::duration_cast<std::chrono::microseconds>(taken).count());
}

}  // namespace

TEST_CASE("A kill at any moment leaves a result whose outputs are complete", "[output]") {
  std::mt19937 random(20260131);
  // Up to about the time of four outputs, however slow machine and build are.
  std::uniform_int_distribution<useconds_t> delay(0, std::max<useconds_t>(60000, microseconds_of_outputs(4)));
  std::size_t most = 0;
  for (int round = 0; round < 20; ++round) {
    const TemporaryDirectory directory;
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) write_until_killed(directory.path());
    while (!std::filesystem::exists(result_path(directory.path()))) usleep(200);
    usleep(delay(random));
    REQUIRE(kill(child, SIGKILL) == 0);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));

    const ResultReader reader(directory.path());
    const std::size_t outputs = reader.steps().size();
    most = std::max(most, outputs);
    for (std::size_t s = 0; s < outputs; ++s) {
      const OutputFrame expected = sample_frame(s, particles);
      REQUIRE(reader.steps()[s].time == expected.time);
      const OutputReader output = reader.output(s);
      for (const Field& field : expected.fields) REQUIRE(output.field(field.name).values == field.values);
    }
    for (const StoredSeries& series : reader.series()) REQUIRE(series.values.size() == outputs);
    ResultFile resumed = ResultFile::reopen(directory.path(), outputs / 2);
    resumed.append(sample_frame(outputs / 2, particles));
    REQUIRE(ResultReader(directory.path()).steps().size() == outputs / 2 + 1);
  }
  CHECK(most > 1);
}
