#include "mpm/wave.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using mpm::ThreadTeam;
using mpm::Wave;
using test::Random;

namespace {

std::vector<std::size_t> random_lines(Random& random, std::size_t count) {
  std::vector<std::size_t> lines{0};
  for (std::size_t line = 0; line < count; ++line)
    lines.push_back(lines.back() + 1 + static_cast<std::size_t>(random.uniform(0.0, 4.0)));
  return lines;
}

std::size_t pieces_before(std::size_t piece) {
  return piece;
}

}  // namespace

TEST_CASE("A stage is taken once for every piece, after the stage before of the lines around", "[threads]") {
  Random random(20261126);
  for (const int threads : {1, 2, 3, 5}) {
    ThreadTeam team(threads);
    Wave wave;
    for (const std::size_t count : {0U, 1U, 2U, 3U, 7U, 40U})
      for (const std::size_t stages : {0U, 1U, 2U, 5U}) {
        CAPTURE(threads, count, stages);
        const std::vector<std::size_t> lines = random_lines(random, count);
        const std::size_t pieces = lines.back();
        const std::size_t slow =
            static_cast<std::size_t>(random.uniform(0.0, 1.0 + 2.0 * static_cast<double>(pieces)));
        std::vector<std::size_t> line_of;
        for (std::size_t line = 0; line < count; ++line) line_of.resize(lines[line + 1], line);
        // Some pieces are no work, some are all of it: threads may get no share at all.
        std::vector<std::size_t> work{0};
        for (std::size_t piece = 0; piece < pieces; ++piece)
          work.push_back(work.back() + static_cast<std::size_t>(std::exp(random.uniform(-1.0, 8.0))));
        const auto work_before = [&](std::size_t piece) { return work[piece]; };
        std::vector<std::atomic<std::size_t>> taken(pieces);  // stages of each piece
        std::atomic<int> early{0};
        wave.run(team, lines, stages, work_before, [&](std::size_t stage, std::size_t piece) {
          const std::size_t line = line_of[piece];
          if (taken[piece] != stage) ++early;
          const std::size_t first = lines[line == 0 ? 0 : line - 1], last = lines[std::min(line + 2, count)];
          for (std::size_t other = first; other < last; ++other)
            if (taken[other] < stage) ++early;
          if (piece == slow) std::this_thread::sleep_for(std::chrono::microseconds(200));
          ++taken[piece];
        });
        CHECK(early == 0);
        for (const auto& n : taken) CHECK(n == stages);
      }
  }
}

TEST_CASE("An exception ends a wave and reaches the caller; the next wave is whole", "[threads]") {
  const std::vector<std::size_t> lines{0, 2, 3, 7, 8, 12};
  for (const int threads : {1, 2, 4}) {
    ThreadTeam team(threads);
    Wave wave;
    for (std::size_t thrower = 0; thrower < 12; ++thrower)
      for (std::size_t at = 0; at < 3; ++at) {
        CHECK_THROWS_AS(wave.run(team, lines, 3, pieces_before,
                                 [&](std::size_t stage, std::size_t piece) {
                                   if (piece == thrower && stage == at) throw std::runtime_error("here");
                                 }),
                        std::runtime_error);
        std::atomic<int> taken{0};
        wave.run(team, lines, 3, pieces_before, [&](std::size_t, std::size_t) { ++taken; });
        CHECK(taken == 36);
      }
  }
}
