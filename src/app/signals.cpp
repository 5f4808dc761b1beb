#include "app/signals.hpp"

#include <csignal>

namespace vitrum::app {
namespace {

volatile std::sig_atomic_t caught = 0;

void remember(int signal) {
  if (caught != 0) std::signal(signal, SIG_DFL);
  caught = signal;
}

}  // namespace

void catch_signals() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

int caught_signal() {
  return caught;
}

}  // namespace vitrum::app
