#include "mpm/thread_team.hpp"

#include <atomic>
#include <new>
#include <stdexcept>

#include "mpm/computation_error.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using mpm::ThreadTeam;

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
