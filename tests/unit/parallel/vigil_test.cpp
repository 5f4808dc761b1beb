#include "parallel/vigil.hpp"

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/catch.hpp"

using std::chrono::microseconds;
using vitrum::parallel::Vigil;

TEST_CASE("Who sleeps is woken by every change", "[threads]") {
  // Two threads that answer each other; a change that is missed ends neither.
  for (const microseconds awake : {microseconds(0), microseconds(3)}) {
    Vigil vigil;
    std::atomic<int> turn{0};
    constexpr int rounds = 4000;
    const auto play = [&](int player) {
      for (int round = 0; round < rounds; ++round) {
        vigil.wait(awake, [&] { return turn == 2 * round + player; });
        ++turn;
        vigil.changed();
      }
    };
    std::thread other(play, 1);
    play(0);
    other.join();
    CHECK(turn == 2 * rounds);
  }
}
