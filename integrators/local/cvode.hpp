#pragma once
#include "integrators/local/cvode_family.hpp"
#include "integrators/local/path_follower.hpp"

namespace vitrum {

/// CVODE for every mode that evolves: variable order and step under error tolerances, roots located by its
/// root finder. One bundle of CVODE memories a thread, used again for every particle.
///
/// A solve that fails is repeated with a small first step, then with BDF, then over ever shorter pieces of
/// the path.
class Cvode final : public PathFollower {
 public:
  Cvode(const LocalTolerance& tolerance, CvodeFamily family) : PathFollower(tolerance), family_(family) {}

 protected:
  bool solve(const ModeEquations& equations, double* y, Stop& stop, PointReport& report) override;

 private:
  CvodeFamily family_;
};

}  // namespace vitrum
