// Arguments of --set, one a line, over a scene in which every model and every kind of shape stands.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "promises.hpp"
#include "scene/read_scene.hpp"
#include "short_run.hpp"

namespace {

constexpr std::string_view scene = R"(title = "small"
[space]
geometry = "axisymmetric"
cell = 1.0e-3
[time]
end = 1.0e-5
[integrator]
method = "explicit"
step = 2.0e-8
[constitutive]
method = "closed-form"
[output]
every = 1.0e-6
[gravity]
acceleration = [0, -9.81]
[[body]]
name = "plate"
material = "glass"
box = {min = [0, 0], max = [0.006, 0.002]}
stress = [1e7, 1e7, 1e7, 0]
[[body]]
name = "rod"
material = "steel"
disk = {centre = [0, 0.0042], radius = 0.002}
velocity = [0, -200.0]
[[body]]
name = "washer"
material = "steel"
ring = {centre = [0.01, 0.01], inner = 0.001, outer = 0.002}
velocity_gradient = [[0, -1e4], [1e4, 0]]
[[body]]
name = "wedge"
material = "glass"
polygon = [[0.004, 0.003], [0.007, 0.003], [0.004, 0.006]]
[[boundary]]
box = {min = [0.006, -inf], max = [inf, 1]}
fix = ["r", "z"]
[material.glass]
density = 2500
young = 72e9
poisson = 0.25
[material.glass.damage]
toughness = 0.83e6
k = 5e26
m = 6
[material.glass.drucker_prager]
yield = 43e6
beta = 1.8
[material.glass.decohesion]
opening = 5e-6
mode_ratio = 50
[material.steel]
density = 7800
young = 195e9
poisson = 0.25
[material.steel.von_mises]
yield = 359e6
peak = 484e6
hardening = 9.6e9
softening = 9.6e9
[material.steel.decohesion]
opening = 1.6e-9
mode_ratio = 1.0
)";

std::vector<std::string> lines(std::string_view text) {
  std::vector<std::string> result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    result.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrum;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::tolerate_refusal([&] { fuzz::exercise(parse_scene(scene, "scene.toml", lines(text))); });
  return 0;
}
