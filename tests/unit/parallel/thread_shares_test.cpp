#include "parallel/thread_shares.hpp"

#include <algorithm>
#include <numeric>

#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using parallel::ThreadShares;
using test::Random;

namespace {

/// Work before every piece, of random pieces.
std::vector<std::size_t> random_work(Random& random, std::size_t pieces) {
  std::vector<std::size_t> before{0};
  for (std::size_t n = 0; n < pieces; ++n)
    before.push_back(before.back() + static_cast<std::size_t>(random.uniform(100.0, 400.0)));
  return before;
}

/// How long threads of these speeds take for their shares.
std::vector<double> seconds(std::span<const std::size_t> bounds, const std::vector<std::size_t>& before,
                            const std::vector<double>& speed) {
  std::vector<double> s;
  for (std::size_t n = 0; n < speed.size(); ++n)
    s.push_back(static_cast<double>(before[bounds[n + 1]] - before[bounds[n]]) / speed[n]);
  return s;
}

}  // namespace

TEST_CASE("Shares are ranges that hold every piece once, at first of equal work", "[threads]") {
  Random random(20261127);
  for (const std::size_t threads : {1U, 2U, 3U, 8U})
    for (const std::size_t pieces : {0U, 1U, 3U, 20U, 300U}) {
      CAPTURE(threads, pieces);
      const auto before = random_work(random, pieces);
      ThreadShares shares;
      const auto bounds = shares.divide(threads, pieces, [&](std::size_t piece) { return before[piece]; });
      REQUIRE(bounds.size() == threads + 1);
      CHECK(bounds.front() == 0);
      CHECK(bounds.back() == pieces);
      CHECK(std::is_sorted(bounds.begin(), bounds.end()));
      const double equal = static_cast<double>(before.back()) / static_cast<double>(threads);
      for (std::size_t n = 0; n < threads; ++n)
        CHECK(std::abs(static_cast<double>(before[bounds[n + 1]] - before[bounds[n]]) - equal) <= 400.0);
    }
}

TEST_CASE("Shares follow the speed of their threads, and what changes on the way", "[threads]") {
  Random random(5);
  for (int trial = 0; trial < 30; ++trial) {
    const std::size_t threads = 2 + static_cast<std::size_t>(trial % 4);
    ThreadShares shares;
    for (int change = 0; change < 3; ++change) {
      CAPTURE(trial, change);
      const std::size_t pieces = 80 + static_cast<std::size_t>(random.uniform(0.0, 80.0));
      const auto before = random_work(random, pieces);
      const auto work_before = [&](std::size_t piece) { return before[piece]; };
      std::vector<double> speed;
      for (std::size_t n = 0; n < threads; ++n) speed.push_back(random.uniform(1.0, 2.0));
      for (int round = 0; round < 200; ++round)
        shares.learn(seconds(shares.divide(threads, pieces, work_before), before, speed));
      const auto times = seconds(shares.divide(threads, pieces, work_before), before, speed);
      const double ideal =
          static_cast<double>(before.back()) / std::accumulate(speed.begin(), speed.end(), 0.0);
      for (const double time : times) CHECK(std::abs(time - ideal) < 2.0 * 400.0);  // a piece at either end
    }
  }
}

TEST_CASE("Shares stay where they are while threads are about equally fast", "[threads]") {
  Random random(6);
  const auto before = random_work(random, 40);
  const auto work_before = [&](std::size_t piece) { return before[piece]; };
  ThreadShares shares;
  const auto first = shares.divide(4, 40, work_before);
  const std::vector<std::size_t> start(first.begin(), first.end());
  for (int round = 0; round < 500; ++round) {
    std::vector<double> speed;
    for (int n = 0; n < 4; ++n) speed.push_back(random.uniform(0.97, 1.03));
    const auto bounds = shares.divide(4, 40, work_before);
    REQUIRE(std::equal(bounds.begin(), bounds.end(), start.begin()));
    shares.learn(seconds(bounds, before, speed));
  }
}

TEST_CASE("Threads without work, or endlessly slow ones, leave shares that hold every piece", "[threads]") {
  ThreadShares shares;
  const auto work_before = [](std::size_t piece) { return piece; };
  for (int round = 0; round < 300; ++round) {
    const auto bounds = shares.divide(3, 100, work_before);
    shares.learn(std::vector<double>{1e-9, 1e9, round % 2 == 0 ? 1.0 : 0.0});
    REQUIRE((bounds[0] == 0 && bounds[1] <= bounds[2] && bounds[2] <= bounds[3] && bounds[3] == 100));
  }
  // Who was slow and is no longer gets its share back.
  for (int round = 0; round < 300; ++round) {
    const auto bounds = shares.divide(3, 100, work_before);
    std::vector<double> s;
    for (std::size_t n = 0; n < 3; ++n) s.push_back(static_cast<double>(bounds[n + 1] - bounds[n]));
    shares.learn(s);
  }
  const auto bounds = shares.divide(3, 100, work_before);
  for (std::size_t n = 0; n < 3; ++n) {
    CHECK(bounds[n + 1] - bounds[n] >= 31);
    CHECK(bounds[n + 1] - bounds[n] <= 36);
  }
}
