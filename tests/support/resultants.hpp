#pragma once
#include <array>

#include "mpm/tractions.hpp"
#include "mpm/transfer.hpp"
#include "scene/build_system.hpp"
#include "scene/read_scene.hpp"
#include "support/mpm_scene.hpp"

namespace vitrum::test {

/// Sum of the nodal forces (N per radian or per metre) at the start of a scene whose bodies have no stress.
inline std::array<double, 2> resultant_of_tractions(const MpmScene& scene) {
  System system = build_system(parse_scene(scene.text(), "test.toml"), 1);
  mpm::refresh_grid(system);
  system.tractions->load(system, 0.0, mpm::configurations(system));
  mpm::scatter(system, mpm::Scatter::momentum_and_force);
  std::array<double, 2> sum{};
  for (std::size_t c = 0; c < 2; ++c) {
    const double* f = system.grid.field(c == 0 ? mpm::Field::force_0 : mpm::Field::force_1);
    for (std::size_t n = 0; n < system.grid.blocks().size() * mpm::block_nodes; ++n) sum[c] += f[n];
  }
  return sum;
}

}  // namespace vitrum::test
