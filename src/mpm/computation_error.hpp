#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>

#include "tensor/symmetric.hpp"

namespace vitrum {

/// A computation that cannot go on: the message names time, body, particle, cause and remedy. Exit status 3.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A particle whose local equations could not be integrated. Its columns still hold the state before the
/// increment.
class PointFailure : public ComputationError {
 public:
  PointFailure(const std::string& message, std::size_t body_index, std::size_t particle_index,
               const SymmetricTensor& strain_increment, double increment_duration)
      : ComputationError(message),
        body(body_index),
        particle(particle_index),
        increment(strain_increment),
        duration(increment_duration) {}

  std::size_t body, particle;  ///< index of the body, place of the particle in its columns
  SymmetricTensor increment;   ///< of strain, in the frame that turns with the particle
  double duration;             ///< s
};

}  // namespace vitrum
