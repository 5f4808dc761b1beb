#pragma once
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "mpm/computation_error.hpp"
#include "scene/input_error.hpp"

/// What every fuzz target demands of the program. A broken promise ends the process, as a sanitizer's finding
/// does.
namespace vitrum::fuzz {

/// Not an exception: no handler may mistake it for an error of the input.
inline void demand(bool kept, const std::string& promise) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", promise.c_str());
  std::abort();
}

/// A refusal consists of facts, one a line.
inline void demand_readable(const InputError& error) {
  demand(!error.messages().empty(), "a refusal says why");
  for (const std::string& message : error.messages())
    demand(!message.empty() && message.find('\n') == std::string::npos, "one fact a line: " + message);
}

/// Runs `body`, which may refuse its input or fail to compute it; every other exception ends the process.
template <class Body>
void tolerate_refusal(Body&& body) {
  try {
    body();
  } catch (const InputError& error) {
    demand_readable(error);
  } catch (const ComputationError& error) {
    demand(*error.what() != '\0', "a failure says why");
  }
}

}  // namespace vitrum::fuzz
