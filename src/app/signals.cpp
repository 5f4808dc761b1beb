#include "app/signals.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <string_view>

namespace vitrum::app {
namespace {

// Handlers run in any thread: what they touch is atomic, and without locks.
std::atomic<int> caught = 0;
std::atomic<std::int64_t> caught_at = 0;  // ns
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

constexpr std::int64_t patience = 500'000'000;  // ns

std::int64_t now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

void remember(int signal) {
  int none = 0;
  if (caught.compare_exchange_strong(none, signal)) {
    caught_at = now();
    return;
  }
  if (signal != SIGINT || now() - caught_at < patience) return;
  constexpr std::string_view message = "interrupted again: ended at once, without a checkpoint\n";
  (void)!write(STDERR_FILENO, message.data(), message.size());
  _exit(128 + signal);
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

bool ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

// What whoever started the program said of SIGHUP (nohup), seen before libraries that take signals over
// (MPI's transports) are initialised.
bool hang_up_ignored = false;
void look_at_hang_up() {
  hang_up_ignored = ignored(SIGHUP);
}
[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)() = look_at_hang_up;

}  // namespace

void catch_signals() {
  // Shells ignore SIGINT for what they start in the background; who sends it there nevertheless means it.
  handle(SIGINT, remember);
  handle(SIGTERM, remember);
  handle(SIGHUP, hang_up_ignored ? SIG_IGN : remember);
}

int caught_signal() {
  return caught;
}

void survive_failing_writes() {
  handle(SIGPIPE, SIG_IGN);
  handle(SIGXFSZ, SIG_IGN);
}

}  // namespace vitrum::app
