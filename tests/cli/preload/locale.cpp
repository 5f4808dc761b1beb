// Preloaded: with LOCALE_FOR_ALL=1 the program starts under the locale of its environment, for C and C++
// alike, as a program does that has asked for it. It does not ask itself; a library that it calls might.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <locale>
#include <stdexcept>

namespace {

struct Start {
  Start() {
    if (std::getenv("LOCALE_FOR_ALL") == nullptr) return;
    try {
      std::locale::global(std::locale(""));
    } catch (const std::runtime_error& error) {
      std::fprintf(stderr, "LOCALE_FOR_ALL: %s\n", error.what());
      _exit(99);
    }
  }
} start;

}  // namespace
