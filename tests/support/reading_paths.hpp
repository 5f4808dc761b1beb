#pragma once
// Glass under one reading of the paper, driven along a path by every local method.
#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/local_solvers.hpp"
#include "support/strain_path.hpp"

namespace vitrum::test {

inline constexpr SymmetricTensor uniaxial{1.0, 0.0, 0.0, 0.0};

/// Calls `check` with the end of the path under the closed form and under every solver.
inline void with_every_method(const MaterialParameters& p, const std::vector<Segment>& path, int steps,
                              const CompositeState& start, const std::function<void(const Driven&)>& check) {
  const auto material = composite_of(p, cell);
  check(drive(*material, path, steps, start));
  for (LocalSolver& solver : solvers(1e-9)) {
    CAPTURE(solver.name);
    const Driven d = drive(*material, path, steps, start, solver.integrator.get());
    REQUIRE(d.cause.empty());
    check(d);
  }
}

inline MaterialParameters glass_with(const std::function<void(MaterialParameters&)>& choose) {
  MaterialParameters p = fracturing_glass();
  p.drucker_prager = glass_drucker_prager();
  choose(p);
  return p;
}
inline Segment stretch(double strain, double rate) {
  return {strain * uniaxial, std::abs(strain) / rate};
}

/// A point of glass without damage whose plane, normal to r, has just separated; its faces touch.
inline CompositeState separated_glass(const MaterialParameters& p) {
  CompositeState s = at_onset(*composite_of(p, cell), 0.0, 50.0e6, {});
  s.decohesion = 1.0;
  return s;
}

}  // namespace vitrum::test
