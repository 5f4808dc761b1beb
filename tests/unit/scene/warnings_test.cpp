#include "catch.hpp"
#include "scene/scene_tables.hpp"
#include "scene/table_view.hpp"

namespace vitrum::scene {

TEST_CASE("warnings stand in the order of the file, then of the command line, and stop nothing", "[scene]") {
  const toml::table document = toml::parse("start = 0.0\nend = 1.0\n");
  Diagnostics diagnostics("a.toml");
  Formulas formulas({"r", "z"});
  const TableView time(document, "time", time_table(), diagnostics, formulas);
  diagnostics.note_override("time.start", 2);
  time.warn("start", "an odd start");
  time.warn("end", "an odd end");
  diagnostics.throw_if_any();
  CHECK(diagnostics.warnings() == std::vector<std::string>{"a.toml:2:7: key 'time.end': an odd end",
                                                           "--set 2: key 'time.start': an odd start"});
}

}  // namespace vitrum::scene
