#include "observe/table.hpp"

#include <fstream>
#include <limits>

#include "catch.hpp"
#include "output/hdf5.hpp"
#include "output/table_store.hpp"
#include "scene/input_error.hpp"
#include "support/random_states.hpp"
#include "unit/output/contains_text.hpp"
#include "unit/output/temporary_directory.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr Column columns[] = {
    {"time", "s", "when"}, {"body", "", "who"}, {"impulse", "N s", "how much", true}};
constexpr TableInfo kind{"pushes", "who is pushed", columns};

}  // namespace

TEST_CASE("Rows round-trip, quote what separates cells, and leave empty what is not there", "[observe]") {
  Table table(kind);
  CHECK(header(kind) == "time,body,impulse");
  table.row(0.1 + 0.2, "plate", std::optional<double>());
  table.row(1e-300, std::string("a \"big\", old one"), std::numeric_limits<double>::quiet_NaN());
  CHECK(table.waiting() == "0.30000000000000004,plate,\n1e-300,\"a \"\"big\"\", old one\",nan\n");
  CHECK(table.is_due());
  table.patience = 1000;
  CHECK_FALSE(table.is_due());
  Archive archive;
  table.save(archive);
  Table other(kind);
  other.restore(archive);  // rows that found no room on a disk are not lost
  CHECK(other.waiting() == table.waiting());
}

TEST_CASE("Rows are due at multiples, once, whatever the steps", "[observe]") {
  Random random(7);
  for (int n = 0; n < 200; ++n) {
    const double interval = random.logarithmic(1e-9, 1.0), start = random.uniform(-20.0, 20.0) * interval;
    Cadence cadence(0.0, interval, start);
    double time = start, told = -std::numeric_limits<double>::infinity();
    const double longest = random.logarithmic(0.01, 5.0) * interval;
    for (int step = 0; step < 100; ++step) {
      // A multiple of the interval in (told, time] asks for a row, and nothing else does.
      const double multiple = std::floor(time / interval) * interval;
      const bool expected = multiple > told && multiple >= start;
      const double to_multiple = std::abs(time / interval - std::round(time / interval));
      if (to_multiple > 1e-6) CHECK(cadence.is_due(time) == expected);
      if (cadence.is_due(time)) cadence.pass(time), told = time;
      CHECK_FALSE(cadence.is_due(time));
      Cadence resumed(0.0, interval, start);
      resumed.restore(cadence.count());
      CHECK(resumed.is_due(time + longest) == cadence.is_due(time + longest));
      time += random.uniform(0.0, longest);
    }
  }
  CHECK_FALSE(Cadence().is_due(1.0));
  CHECK(Cadence().at_outputs());
  Cadence tenth(0.0, 0.1, 0.0);
  CHECK(tenth.is_due(0.0));
  tenth.pass(0.2);
  CHECK(tenth.is_due(0.1 + 0.2));
  tenth.pass(0.3);
  CHECK_FALSE(tenth.is_due(0.1 + 0.2));  // rounding is no multiple of its own
}

TEST_CASE("tables.h5 holds what the files hold", "[observe]") {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "pushes.csv")
      << "time,body,impulse\n0.30000000000000004,plate,\n1,\"a, \"\"b\"\"\",-2.5\n2,plate,nan\n";
  output::store_tables(directory.path(), {{kind}}, true);
  {
    const output::File file = output::File::open_to_read(directory.path() / "tables.h5");
    const output::Group group = file.root().open_group("pushes");
    CHECK(group.read_doubles("time") == std::vector<double>{0.1 + 0.2, 1.0, 2.0});
    CHECK(group.read_indices("body") == std::vector<std::uint32_t>{0, 1, 0});
    CHECK(group.read_texts("body_names") == std::vector<std::string>{"plate", "a, \"b\""});
    const std::vector<double> impulse = group.read_doubles("impulse");
    CHECK((std::isnan(impulse[0]) && impulse[1] == -2.5 && std::isnan(impulse[2])));
    CHECK(group.text_attribute("impulse", "unit") == "N s/m");
  }
  for (const char* row : {"1,plate\n", "1,plate,2,3\n", "1,plate,two\n", "1,plate,2x\n"}) {
    std::ofstream(directory.path() / "pushes.csv") << "time,body,impulse\n0,plate,1\n" << row;
    CHECK_THROWS_WITH(output::store_tables(directory.path(), {{kind}}, true),
                      contains_text("pushes.csv:3: is no row"));
  }
  std::ofstream(directory.path() / "pushes.csv") << "time,body\n";
  CHECK_THROWS_AS(output::store_tables(directory.path(), {{kind}}, true), FileError);
}
