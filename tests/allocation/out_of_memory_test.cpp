// Memory that runs out at any moment of a run ends the program with a message and status 3, and leaves
// nothing half done: no std::terminate, no crash, no result that cannot be read.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "failing_new.hpp"
#include "output/result_layout.hpp"
#include "output/result_reader.hpp"
#include "parallel/wave.hpp"
#include "tests/catch.hpp"
#include "unit/output/temporary_directory.hpp"
#include "vitrum_source_dir.hpp"

using namespace vitrum;
using test::Failing;

namespace {

/// What a command comes to whose allocation after `successes` successful ones fails.
struct Answer {
  int status;       ///< -1: ended by a signal
  bool has_failed;  ///< an allocation has
  bool is_told;     ///< something was said on standard error
};

/// In a process of its own, as the program would be.
Answer run(std::vector<std::string> arguments, long successes, Failing failing) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  std::array<int, 2> messages{}, flag{};
  REQUIRE((pipe2(messages.data(), O_NONBLOCK) == 0 && pipe2(flag.data(), O_NONBLOCK) == 0));
  const pid_t child = fork();
  if (child == 0) {
    dup2(messages[1], STDERR_FILENO);
    const test::FailingNew memory(successes, failing, flag[1]);
    std::_Exit(app::command_line(static_cast<int>(pointers.size()), pointers.data()));
  }
  int status = 0;
  waitpid(child, &status, 0);
  char byte = 0;
  const bool has_failed = read(flag[0], &byte, 1) == 1, is_told = read(messages[0], &byte, 1) == 1;
  for (const int end : {messages[0], messages[1], flag[0], flag[1]}) close(end);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, has_failed, is_told};
}

/// Runs the impact scene for some steps with ever later failures, until none happens; their number.
int sweep(const std::vector<std::string>& method, Failing failing) {
  const TemporaryDirectory directory;
  const std::string folder = (directory.path() / "out").string();
  std::vector<std::string> arguments{"vitrum",
                                     "run",
                                     VITRUM_SOURCE_DIR "/tests/cli/scenes/impact.toml",
                                     "--out",
                                     folder,
                                     "--quiet",
                                     "--threads",
                                     "2",
                                     "--set",
                                     "time.end=2e-7",
                                     "--set",
                                     "output.every=1e-7",
                                     "--set",
                                     "output.checkpoint_every=1e-7"};
  arguments.insert(arguments.end(), method.begin(), method.end());
  int failures = 0;
  for (long successes = 0;; successes += 1 + successes / 20) {
    const Answer answer = run(arguments, successes, failing);
    INFO("after " << successes << " allocations: status " << answer.status);
    if (std::filesystem::exists(output::result_path(folder)))
      CHECK_NOTHROW(output::ResultReader(folder).series());
    if (!answer.has_failed) {
      CHECK(answer.status == app::exit_done);
      return failures;
    }
    ++failures;
    if (failing == Failing::from_then_on || answer.status == app::exit_computation) {
      CHECK(answer.status == app::exit_computation);
      CHECK(answer.is_told);
    } else {
      // One failure may be made good, or (streams and HDF5 swallow exceptions) look like a number that cannot
      // be read or a file that cannot be written: then something is said.
      CHECK((answer.status == app::exit_done || answer.status == app::exit_input ||
             answer.status == app::exit_file));
      CHECK((answer.status == app::exit_done || answer.is_told));
    }
    std::filesystem::remove_all(folder);
  }
}

const std::vector<std::vector<std::string>> methods{
    {},
    {"--set", "constitutive.method=\"cvode\""},
    {"--set", "integrator.method=\"arkode-explicit\""},
    {"--set", "integrator.method=\"arkode-implicit\""},
    {"--set", "integrator.method=\"arkode-implicit\"", "--set", "integrator.linear_solver=\"gmres\""},
};

}  // namespace

TEST_CASE("One allocation that fails ends a run with status 3, or does no harm", "[memory]") {
  for (const auto& method : methods) CHECK(sweep(method, Failing::once) > 50);
}

TEST_CASE("Memory that has run out for good ends a run with status 3", "[memory]") {
  for (const auto& method : methods) CHECK(sweep(method, Failing::from_then_on) > 50);
}

TEST_CASE("Memory that runs out in a wave ends it, on any thread", "[memory]") {
  std::vector<std::size_t> lines;
  for (std::size_t line = 0; line <= 40; ++line) lines.push_back(2 * line);
  const int nowhere = open("/dev/null", O_WRONLY);
  for (const int threads : {2, 3}) {
    parallel::ThreadTeam team(threads);
    int failures = 0;
    for (bool fails = true; fails; failures += fails ? 1 : 0) {
      parallel::Wave wave;
      const test::FailingNew memory(failures, Failing::once, nowhere);
      try {
        wave.share_out(team, lines, [](std::size_t piece) { return piece; });
        wave.run(team, lines, 6, 7, [](std::size_t, std::size_t) {});
        fails = false;
      } catch (const std::bad_alloc&) {
      }
    }
    CHECK(failures > 6);
  }
  close(nowhere);
}
