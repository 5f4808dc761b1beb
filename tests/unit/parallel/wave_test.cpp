#include "parallel/wave.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using parallel::ThreadTeam;
using parallel::Wave;
using test::Random;

namespace {

/// Lines of one to 30 pieces, most of them short.
std::vector<std::size_t> random_lines(Random& random, std::size_t count) {
  std::vector<std::size_t> lines{0};
  for (std::size_t line = 0; line < count; ++line)
    lines.push_back(lines.back() + static_cast<std::size_t>(std::exp(random.uniform(0.0, std::log(31.0)))));
  return lines;
}

std::size_t pieces_before(std::size_t piece) {
  return piece;
}

}  // namespace

TEST_CASE("A stage is taken once for every piece, after the stage before of the lines around; few at once",
          "[threads]") {
  Random random(20261126);
  for (const int threads : {1, 2, 3, 5}) {
    ThreadTeam team(threads);
    Wave wave;
    for (const std::size_t count : {0U, 1U, 2U, 3U, 7U, 15U, 40U, 90U})
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
        std::vector<std::atomic<bool>> begun(pieces);
        std::atomic<int> early{0}, too_many{0};
        const auto around = [&](std::size_t line, const auto& holds) {
          const std::size_t first = lines[line == 0 ? 0 : line - 1], last = lines[std::min(line + 2, count)];
          return std::all_of(taken.begin() + static_cast<std::ptrdiff_t>(first),
                             taken.begin() + static_cast<std::ptrdiff_t>(last), holds);
        };
        const auto shares = wave.share_out(team, lines, work_before);
        const auto share_of = [&](std::size_t piece) {
          return std::upper_bound(shares.begin(), shares.end(), piece) - shares.begin();
        };
        const std::size_t at_once =
            Wave::fewest_at_once(stages) + static_cast<std::size_t>(random.uniform(0.0, 4.0));
        wave.run(team, lines, stages, at_once, [&](std::size_t stage, std::size_t piece) {
          const std::size_t line = line_of[piece];
          if (taken[piece] != stage) ++early;
          if (!around(line, [&](const auto& n) { return n >= stage; })) ++early;
          begun[piece] = true;
          for (std::size_t other = 0; other < pieces; ++other) {
            const std::size_t far = std::max(line, line_of[other]) - std::min(line, line_of[other]);
            if (stage == 0 && far >= at_once && share_of(other) == share_of(piece) && begun[other] &&
                !around(line_of[other], [&](const auto& n) { return n == stages; }))
              ++too_many;
          }
          if (piece == slow) std::this_thread::sleep_for(std::chrono::microseconds(200));
          ++taken[piece];
        });
        CHECK(early == 0);
        CHECK(too_many == 0);
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
        wave.share_out(team, lines, pieces_before);
        CHECK_THROWS_AS(wave.run(team, lines, 3, 4,
                                 [&](std::size_t stage, std::size_t piece) {
                                   if (piece == thrower && stage == at) throw std::runtime_error("here");
                                 }),
                        std::runtime_error);
        std::atomic<int> taken{0};
        wave.run(team, lines, 3, 4, [&](std::size_t, std::size_t) { ++taken; });
        CHECK(taken == 36);
      }
  }
}

TEST_CASE("Two threads begin a wave where their shares meet", "[threads]") {
  std::vector<std::size_t> lines;
  for (std::size_t piece = 0; piece <= 80; ++piece) lines.push_back(piece);
  ThreadTeam team(2);
  Wave wave;
  const std::size_t border = wave.share_out(team, lines, pieces_before)[1];
  REQUIRE(border == 40);
  std::mutex mutex;
  std::map<std::thread::id, std::size_t> first;  // piece of each thread
  const auto begun = [&](std::size_t piece) {
    const std::lock_guard lock(mutex);
    first.try_emplace(std::this_thread::get_id(), piece);
    return first.size();
  };
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  wave.run(team, lines, 3, 4, [&](std::size_t, std::size_t piece) {
    // Who is late must find what is its own.
    while (begun(piece) < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  });
  REQUIRE(first.size() == 2);
  CHECK(first.at(std::this_thread::get_id()) == border - 1);
  for (const auto& [thread, piece] : first)
    if (thread != std::this_thread::get_id()) CHECK(piece == border);
}
