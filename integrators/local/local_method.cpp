#include "integrators/local/local_method.hpp"

#include "integrators/local/closed_form.hpp"
#include "integrators/local/cvode.hpp"
#include "integrators/local/substep.hpp"

namespace vitrum {

std::unique_ptr<LocalIntegrator> make_local_integrator(const ConstitutiveDefinition& constitutive) {
  const LocalTolerance tolerance{constitutive.rtol, constitutive.atol};
  switch (constitutive.method) {
    case LocalMethod::closed_form:
      return std::make_unique<ClosedForm>();
    case LocalMethod::substep:
      return std::make_unique<Substep>(tolerance);
    case LocalMethod::cvode:
      return std::make_unique<Cvode>(tolerance, constitutive.solver);
  }
  return nullptr;
}

}  // namespace vitrum
