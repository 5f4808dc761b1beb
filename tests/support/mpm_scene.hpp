#pragma once
#include <fmt/format.h>

#include <array>
#include <string>

namespace vitrum::test {

/// A number as TOML, exact to the last bit.
inline std::string number(double x) {
  return fmt::format("{:.17g}", x);
}
inline std::string pair(std::array<double, 2> x) {
  return fmt::format("[{:.17g}, {:.17g}]", x[0], x[1]);
}

/// An elastic material in which density, pressure wave speed and hence the p-wave modulus are 1 (nu = 0.25).
inline constexpr double unit_young = 1.0 / 1.2, unit_poisson = 0.25, unit_shear = 1.0 / 3.0;

/// A scene for the tests of the momentum equations: what they leave out has the value given here.
struct MpmScene {
  std::string geometry = "plane-strain";
  std::string shape = "linear";
  std::string gradients = "nodes";
  double cell = 1.0;
  std::string method = "explicit";
  std::string scheme = "usf";
  std::string pace = "courant = 0.2";  ///< or "step = ...", or lines of an adaptive method
  double density = 1.0, young = unit_young, poisson = unit_poisson;
  std::string
      tables;  ///< [[body]], [[boundary]], [gravity], [material.NAME.MODEL]; bodies are made of "elastic"

  std::string text() const {
    return fmt::format(
        "[space]\ngeometry = \"{}\"\ncell = {:.17g}\nshape_functions = \"{}\"\ngradients = "
        "\"{}\"\n[time]\nend = 1.0\n"
        "[integrator]\nmethod = \"{}\"\nscheme = \"{}\"\n{}\n{}\n"
        "[material.elastic]\ndensity = {:.17g}\nyoung = {:.17g}\npoisson = {:.17g}\n",
        geometry, cell, shape, gradients, method, scheme, pace, tables, density, young, poisson);
  }
};

inline std::string fixed_step(double step) {
  return "step = " + number(step);
}

/// A [[body]] table. more: further lines, such as `velocity = [1, 0]`.
inline std::string body(const std::string& name, const std::string& shape, const std::string& more = "") {
  return fmt::format("[[body]]\nname = \"{}\"\nmaterial = \"elastic\"\n{}\n{}\n", name, shape, more);
}
inline std::string box(std::array<double, 2> min, std::array<double, 2> max) {
  return fmt::format("box = {{min = {}, max = {}}}", pair(min), pair(max));
}
inline std::string disk(std::array<double, 2> centre, double radius) {
  return fmt::format("disk = {{centre = {}, radius = {:.17g}}}", pair(centre), radius);
}
/// A [[boundary]] table. fix: as in the scene, e.g. `"x", "y"`; box sides may be "inf".
inline std::string hold(const std::string& min, const std::string& max, const std::string& fix,
                        std::array<double, 2> velocity = {0.0, 0.0}) {
  return fmt::format("[[boundary]]\nbox = {{min = {}, max = {}}}\nfix = [{}]\nvelocity = {}\n", min, max, fix,
                     pair(velocity));
}
/// Holds one component everywhere: motion is one-dimensional.
inline std::string hold_everywhere(const std::string& component) {
  return hold("[-inf, -inf]", "[inf, inf]", "\"" + component + "\"");
}

}  // namespace vitrum::test
