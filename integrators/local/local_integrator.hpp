#pragma once
#include "materials/law.hpp"

namespace vitrum {

/// Integrates the local constitutive equations of many points over one increment.
class LocalIntegrator : public PointIntegrator {
 public:
  using PointIntegrator::integrate;
  /// Takes particles [begin, end) over `duration` seconds; adds to `report`. Called from several threads on
  /// disjoint ranges.
  virtual void integrate(const Material& material, const ParticleColumns& particles, std::size_t begin,
                         std::size_t end, double duration, BatchReport& report) = 0;
};

}  // namespace vitrum
