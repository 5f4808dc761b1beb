#pragma once
#include "integrators/local/local_integrator.hpp"

namespace vitrum {

/// The materials' own responses: return mappings and secant damage, with events located inside the increment.
class ClosedForm final : public LocalIntegrator {
 public:
  void integrate(const Material& material, const ParticleColumns& particles, std::size_t begin,
                 std::size_t end, double duration, BatchReport& report) override;
  void integrate(const Material& material, PointState& state, const SymmetricTensor& strain_increment,
                 double duration, PointReport& report) override;
};

}  // namespace vitrum
