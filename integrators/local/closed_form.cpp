#include "integrators/local/closed_form.hpp"

namespace vitrum {

void ClosedForm::integrate(const Material& material, const ParticleColumns& particles, std::size_t begin,
                           std::size_t end, double duration, BatchReport& report) {
  material.advance(particles, begin, end, duration, nullptr, report);
}

void ClosedForm::integrate(const Material& material, PointState& state,
                           const SymmetricTensor& strain_increment, double duration, PointReport& report) {
  material.advance(state, strain_increment, duration, report);
}

}  // namespace vitrum
