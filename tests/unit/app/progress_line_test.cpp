#include "app/progress_line.hpp"

#include <random>

#include "app/terminal.hpp"
#include "catch.hpp"

using namespace vitrum;
using namespace vitrum::app;

TEST_CASE("A progress line is never wider than it may be", "[app]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-12.0, 12.0), part(0.0, 1.0);
  std::uniform_int_distribution<std::int64_t> steps(0, 1'000'000'000'000);
  for (int n = 0; n < 500; ++n) {
    Standing s;
    s.part = part(random);
    for (double* value : {&s.left, &s.time, &s.step, &s.energy.initial, &s.energy.kinetic, &s.energy.elastic})
      *value = std::pow(10.0, exponent(random));
    s.counters.steps = steps(random), s.counters.rejected = steps(random);
    std::size_t before = 0;
    for (std::size_t columns = 0; columns < 220; ++columns) {
      const std::string line = progress_line(s, columns);
      REQUIRE(line.size() <= columns);
      CHECK(line.size() + 30 >= before);  // more room, no less told
      before = line.size();
      if (columns >= 5) CHECK(line.find(" %") != std::string::npos);
    }
  }
}

TEST_CASE("Text is wrapped between words, a command in one piece", "[app]") {
  CHECK(wrapped("one two three", 8) == "one two\n  three");
  CHECK(wrapped("one two three", 13) == "one two three");
  CHECK(wrapped("one  two", 20) == "one  two");
  CHECK(wrapped("do `a b c d` now", 10) == "do\n  `a b c d`\n  now");
  CHECK(wrapped("unbreakable", 4) == "unbreakable");
  CHECK(wrapped("Glas\u00e4\u00f6 zu", 9) == "Glas\u00e4\u00f6 zu");
  CHECK(wrapped("", 4).empty());
}
