#include "parallel/thread_team.hpp"

#include <atomic>
#include <chrono>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/catch.hpp"

using namespace vitrum;
using parallel::ThreadTeam;

TEST_CASE("An exception on any thread reaches the caller, and the team goes on working", "[threads]") {
  for (const int threads : {1, 2, 4}) {
    ThreadTeam team(threads);
    for (std::size_t thrower = 0; thrower < 64; thrower += 7) {
      CHECK_THROWS_AS(team.for_each_chunk(64,
                                          [&](std::size_t chunk) {
                                            if (chunk == thrower) throw std::bad_alloc();
                                          }),
                      std::bad_alloc);
      std::atomic<int> done{0};
      team.for_each_chunk(64, [&](std::size_t) { ++done; });
      CHECK(done == 64);
    }
    CHECK_THROWS_AS(team.for_each_chunk(64, [](std::size_t) { throw std::runtime_error("all"); }),
                    std::runtime_error);
  }
}

TEST_CASE("Every chunk is done once, whoever is slow", "[threads]") {
  for (const int threads : {1, 2, 3}) {
    ThreadTeam team(threads);
    for (const std::size_t chunks : {0U, 1U, 2U, 5U, 100U}) {
      std::vector<std::atomic<int>> done(chunks);
      team.for_each_chunk(chunks, [&](std::size_t chunk) {
        if (chunk == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ++done[chunk];
      });
      for (const auto& times : done) CHECK(times == 1);
    }
  }
}

TEST_CASE("The calling thread may use the same processors after a team's life as before", "[threads]") {
  cpu_set_t before, after;
  REQUIRE(pthread_getaffinity_np(pthread_self(), sizeof before, &before) == 0);
  { const ThreadTeam team(CPU_COUNT(&before)); }
  REQUIRE(pthread_getaffinity_np(pthread_self(), sizeof after, &after) == 0);
  CHECK(CPU_EQUAL(&before, &after));
}
