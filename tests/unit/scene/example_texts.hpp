#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

namespace vitrum::test {

/// A small valid scene that uses most keys. Malformed inputs are made from it by replacing parts of single
/// lines, so that the line numbers hold.
inline constexpr std::string_view scene_text = R"(title = "test"
[space]
geometry = "axisymmetric"
cell = 1.0e-3
[time]
end = 1.0e-4
[integrator]
method = "explicit"
step = 1.0e-7
[[body]]  # line 10
name = "plate"
material = "glass"
box = {min = [0, 0], max = [0.2, 0.005]}
[[body]]
name = "rod"
material = "steel"
disk = {centre = [0, 0.01], radius = 0.004}
velocity = [0, -200.0]
[[boundary]]
box = {min = [0.2, -inf], max = [inf, 1]}  # line 20
fix = ["r", "z"]
[material.glass]
density = 2500
young = 72e9
poisson = 0.25
[material.glass.damage]
toughness = 0.83e6
k = 5e26
m = 6
[material.steel]  # line 30
density = 7800
young = 195e9
poisson = 0.25
[material.steel.von_mises]
yield = 359e6
peak = 484e6
hardening = 9.6e9
softening = 9.6e9
)";

inline constexpr std::string_view point_text = R"([material.glass]
density = 2500
young = 72e9
poisson = 0.25
[path]
time = [0, 1e-6, 2e-6]
strain = [[0, 0, 0, 0], [1e-4, 0, 0, 0], [0, 0, 0, 1e-4]]
size = 1e-3
)";

/// `text` with its only occurrence of `from` replaced. Throws std::logic_error unless there is exactly one.
inline std::string with(std::string_view text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  if (at == std::string_view::npos || text.find(from, at + 1) != std::string_view::npos)
    throw std::logic_error("not exactly once in the text: " + std::string(from));
  return std::string(text).replace(at, from.size(), to);
}

}  // namespace vitrum::test
