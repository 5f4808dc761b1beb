// The reduced equations of Newton's method: for changes of velocity alone.
#include <algorithm>
#include <cmath>

#include "integrators/grid/grid_system.hpp"

namespace vitrum {

bool GridSystem::linearise(double t, const double* y) {
  const bool changed = deform(t, y), touching = touch();
  const mpm::Trial::Scope scope(system_, trial_);
  set_increments(false);
  try_stress(t, changed);
  mpm::gather_tangents(system_, trial_, std::max(0.0, t - committed_time_), tangents_);
  stiffness_.assemble(system_, nodes_, gradients_, tangents_, stiffness_values_);
  if (touching)
    system_.contact->linearise(
        [&](const mpm::CarrierPair& pair, const mpm::Vector& force, const mpm::Vector& stretch,
            double stiffness) { stiffness_.add(pair, force, stretch, stiffness, stiffness_values_); });
  if (system_.tractions) {
    system_.tractions->load(system_, t, places());
    mpm::Contact::unload(system_);
    if (!system_.tractions->by_turn().empty())
      stiffness_.add_followers(system_, nodes_, system_.tractions->by_turn(), stiffness_values_);
  }
  mass_.times(stiffness_.pattern(), stiffness_values_, pattern_, mobile_stiffness_);
  double sum = 0.0;
  for (const double k : mobile_stiffness_) sum += k;
  return std::isfinite(sum);
}

void GridSystem::form(double gamma, double* values) const {
  // (I - gamma J) x = b with u' = v, m v' = M (1/m) f(u): eliminating x_u leaves (m + gamma^2 M (1/m) K) x_v
  // = m b_v - gamma M (1/m) K b_u.
  for (std::size_t k = 0; k < mobile_stiffness_.size(); ++k) values[k] = gamma * gamma * mobile_stiffness_[k];
  for (std::size_t k = 0; k < nodes_.size(); ++k) values[diagonal_[k]] += nodes_.mass[k];
}

void GridSystem::reduce(double gamma, const double* b, double* c) const {
  const std::size_t n = nodes_.size();
  for (std::size_t k = 0; k < n; ++k) c[k] = nodes_.mass[k] * b[n + k];
  for (std::size_t k = 0; k < n; ++k)
    for (auto e = static_cast<std::size_t>(pattern_.column[k]);
         e < static_cast<std::size_t>(pattern_.column[k + 1]); ++e)
      c[pattern_.row[e]] -= gamma * mobile_stiffness_[e] * b[k];
}

void GridSystem::expand(double gamma, const double* b, const double* z, double* x) const {
  const std::size_t n = nodes_.size();
  for (std::size_t k = 0; k < n; ++k) x[k] = b[k] + gamma * z[k], x[n + k] = z[k];
  std::copy(b + 2 * n, b + size(), x + 2 * n);  // depends on the others, not they on it
}

}  // namespace vitrum
