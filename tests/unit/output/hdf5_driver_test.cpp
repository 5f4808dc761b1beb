#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "output/hdf5.hpp"
#include "temporary_directory.hpp"
#include "tests/catch.hpp"

using namespace vitrum::output;

namespace {

/// Fills a file, whose length is limited, with several times as much, and reads everything back; the message
/// of close().
std::string fill(const std::filesystem::path& path, rlim_t limit) {
  const rlimit limits{limit, limit};
  std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &limits);
  std::vector<double> values(2000);
  File file = File::create(path);
  for (int n = 0; n < 40; ++n) {
    std::iota(values.begin(), values.end(), n);
    const Group group = file.root().create_group("group " + std::to_string(n));
    group.write("values", values);
    group.set_attribute("values", "unit", std::string("m"));
    group.create_series("series");
    group.write_row("series", 3, 7.0);
    if (n > 0) group.copy("series", file.root().open_group("group 0").create_group(std::to_string(n)));
  }
  for (int n = 0; n < 40; ++n) {
    std::iota(values.begin(), values.end(), n);
    const Group group = file.root().open_group("group " + std::to_string(n));
    if (group.read_doubles("values") != values || group.text_attribute("values", "unit") != "m")
      return "what was written is not read back";
  }
  try {
    file.close();
  } catch (const Hdf5Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("HDF5 survives a disk that is full at any place", "[output]") {
  const vitrum::TemporaryDirectory directory;
  const auto path = directory.path() / "file.h5";
  // Before the first byte, within the header, among objects and data, and just beyond the end of all.
  for (const rlim_t limit : {0, 50, 100, 1000, 5000, 20000, 100001, 500000, 700000, 1 << 20}) {
    INFO(limit);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      const std::string message = fill(path, limit);
      const std::string expected =
          limit == 1 << 20 ? "" : path.string() + ": cannot write the file: File too large";
      exit(message == expected ? 0 : 1);  // through HDF5's own clean-up
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
  }
}
