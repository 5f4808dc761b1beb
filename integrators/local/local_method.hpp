#pragma once
#include <memory>

#include "integrators/local/definition.hpp"
#include "integrators/local/local_integrator.hpp"

namespace vitrum {

/// The local integrator that [constitutive] names.
std::unique_ptr<LocalIntegrator> make_local_integrator(const ConstitutiveDefinition& constitutive);

}  // namespace vitrum
