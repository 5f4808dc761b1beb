// Preloaded: with TAKES_SIGNAL a library that takes SIGHUP over before main, whatever the shell said, and
// dies of it.
#include <csignal>
#include <cstdlib>

namespace {

void die(int number) {
  std::signal(number, SIG_DFL);
  std::raise(number);
}

[[gnu::constructor]] void take() {
  if (std::getenv("TAKES_SIGNAL") != nullptr) std::signal(SIGHUP, die);
}

}  // namespace
