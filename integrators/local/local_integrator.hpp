#pragma once
#include "materials/material.hpp"

namespace vitrum {

/// Integrates the local constitutive equations of many points over one increment.
class LocalIntegrator {
 public:
  virtual ~LocalIntegrator() = default;
  /// Takes particles [begin, end) over `duration` seconds; adds to `report`. Called from several threads on
  /// disjoint ranges.
  virtual void integrate(const Material& material, const ParticleColumns& particles, std::size_t begin,
                         std::size_t end, double duration, BatchReport& report) = 0;
  /// The same for one point.
  virtual void integrate(const Material& material, PointState& state, const SymmetricTensor& strain_increment,
                         double duration, PointReport& report) = 0;
};

}  // namespace vitrum
