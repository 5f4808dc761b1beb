#include <algorithm>
#include <cmath>

#include "malformed_input.hpp"
#include "scene/build_system.hpp"
#include "scene/input_error.hpp"
#include "scene/perturbation.hpp"
#include "scene/write_scene.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

Scene perturbed(std::string_view value) {
  return parse_scene(scene_text, "s.toml", {"body.0.perturbation=" + std::string(value)});
}

}  // namespace

TEST_CASE("displacements fill their square evenly, and a seed is a sequence", "[scene]") {
  const auto shifts = displacements({1e-3, 7}, 2.0, 20000);
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    double sum = 0.0, squares = 0.0, largest = 0.0;
    for (const Vector2& shift : shifts) {
      sum += shift[k], squares += shift[k] * shift[k];
      largest = std::max(largest, std::abs(shift[k]));
    }
    CHECK(largest < 2e-3);
    CHECK(largest > 1.99e-3);
    CHECK(std::abs(sum / 20000) < 4.0 * 2e-3 / std::sqrt(3.0 * 20000));
    CHECK(squares / 20000 == Approx(4e-6 / 3.0).epsilon(0.03));
  }
  CHECK(displacements({1e-3, 7}, 2.0, 20000) == shifts);
  CHECK(displacements({1e-3, 8}, 2.0, 3)[2] != shifts[2]);
  CHECK(displacements({0.0, 7}, 2.0, 3) == std::vector<Vector2>(3, Vector2{0.0, 0.0}));
}

TEST_CASE("a perturbation moves the particles of its body and nothing else", "[scene]") {
  const System plain = build_system(parse_scene(scene_text, "s.toml"), 1),
               moved = build_system(perturbed("{amplitude = 0.01, seed = 3}"), 1);
  for (const std::size_t b : {std::size_t{0}, std::size_t{1}}) {
    const Particles &p = plain.bodies[b].particles, &q = moved.bodies[b].particles;
    CHECK(p.mass == q.mass);
    CHECK(p.velocity == q.velocity);
    double largest = 0.0;
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
      for (std::size_t i = 0; i < p.size; ++i)
        largest = std::max(largest, std::abs(q.position[k][i] - p.position[k][i]));
    CHECK(largest <= 1.0001e-5);
    CHECK(largest > (b == 0 ? 0.99e-5 : -1.0));
    if (b == 1) CHECK(largest == 0.0);
  }
}

TEST_CASE("perturbations that cannot be", "[scene]") {
  require_scene_faults({
      {"velocity = [0, -200.0]",
       "perturbation = {amplitude = 0.2}",
       "s.toml:18:29: key 'body.1.perturbation.amplitude': ",
       {"found 0.2, expected a number in [0, 0.1]"}},
      {"velocity = [0, -200.0]",
       "perturbation = {amplitude = 0.1, seed = 1.5}",
       "s.toml:18:41: key 'body.1.perturbation.seed': ",
       {"found 1.5, expected an integer from 0"}},
      {"velocity = [0, -200.0]",
       "perturbation = {seed = 1}",
       "s.toml:18:16: key 'body.1.perturbation",
       {"amplitude"}},
  });
  // A sliver of a twentieth of a cell beside the axis.
  const Scene sliver = parse_scene(scene_text, "s.toml",
                                   {"body.0.box.max.0=5e-5", "body.0.perturbation={amplitude=0.1, seed=1}"});
  CHECK_THROWS_AS(build_system(sliver, 1), InputError);
}

TEST_CASE("a perturbation is written into the resolved scene", "[scene]") {
  const std::string text = resolved_toml(perturbed("{amplitude = 1e-12}"));
  CHECK(text.find("perturbation = {amplitude = 1e-12, seed = 1}") != std::string::npos);
  CHECK(resolved_toml(parse_scene(text, "resolved")) == text);
  CHECK(resolved_toml(parse_scene(scene_text, "s.toml")).find("perturbation") == std::string::npos);
}
