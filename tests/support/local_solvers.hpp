#pragma once
#include <memory>
#include <string>
#include <vector>

#include "integrators/local/cvode.hpp"
#include "integrators/local/substep.hpp"

// The local integrators that follow the ODE forms of the laws.

namespace vitrum::test {

struct LocalSolver {
  std::string name;
  std::unique_ptr<LocalIntegrator> integrator;
};

inline std::vector<LocalSolver> solvers(double rtol) {
  const LocalTolerance tolerance{rtol, 1e-3 * rtol};
  std::vector<LocalSolver> all;
  all.push_back({"substep", std::make_unique<Substep>(tolerance)});
  all.push_back({"cvode bdf", std::make_unique<Cvode>(tolerance, CvodeFamily::bdf)});
  all.push_back({"cvode adams", std::make_unique<Cvode>(tolerance, CvodeFamily::adams)});
  return all;
}

}  // namespace vitrum::test
