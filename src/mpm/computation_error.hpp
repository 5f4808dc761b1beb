#pragma once
#include <stdexcept>
#include <string>

namespace vitrum {

/// A computation that cannot go on: the message names time, body, particle, cause and remedy. Exit status 3.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vitrum
