#pragma once
#include "app/warnings.hpp"

namespace vitrum::app {

/// Factors of so many unknowns that steps without them are faster, where that is known: waves of an impact
/// (docs/reports/performance.md). In slower motion GMRES without factors takes many times as long as KLU.
void warn_of_factors(const Scene& scene, const System& system, Warnings& list);

}  // namespace vitrum::app
