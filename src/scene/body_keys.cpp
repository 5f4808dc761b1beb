#include <array>
#include <limits>
#include <utility>

#include "scene/choices.hpp"
#include "scene/scene_keys.hpp"

namespace vitrum::scene::keys {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Bounds positive{0.0, infinite, true, true};
constexpr Bounds finite{-infinite, infinite, true, true};
constexpr Bounds extended{-infinite, infinite};

KeyInfo bounded(KeyInfo key, const Bounds& bounds) {
  key.bounds = bounds;
  return key;
}

std::vector<KeyInfo> box_with(const Bounds& bounds) {
  return {required(list_key("min", 2, bounds, "m", "lower left corner")),
          required(list_key("max", 2, bounds, "m", "upper right corner"))};
}

std::vector<KeyInfo> boundary_keys(Geometry geometry) {
  KeyInfo fix = choice_key("fix", component_names(geometry),
                           "velocity components held: \"r\", \"z\", or \"x\", \"y\" in plane strain");
  fix.expected = "a list of " + quoted_list(fix.choices);
  return {
      text_key("name", "unique; names the boundary in messages; absent: `boundary.N`, counted from 0"),
      required(other_key("box", "a table {min = [..], max = [..]}",
                         "acts on the grid nodes inside or on it; sides may be infinite, opposite sides may "
                         "coincide; deep boxes that hold one component at 0 have faces that are planes of "
                         "symmetry")),
      required(std::move(fix)),
      defaulted(list_key("velocity", 2, finite, "m/s", "value of the held components"), "[0.0, 0.0]"),
      defaulted(flag_key("moves",
                         "the box moves with its velocity from `time.start` on, by whole cells; false: it "
                         "stays, and what it holds flows through"),
                "true"),
      defaulted(bounded(other_key("priority", "an integer from -1000 to 1000",
                                  "where boundaries hold the same component of a node, the largest acts; "
                                  "different velocities with the same priority are an error"),
                        {-1000.0, 1000.0}),
                "0"),
  };
}

}  // namespace

KeyTable body() {
  static const std::vector<KeyInfo> keys{
      required(text_key("name", "unique; names the body in results and messages")),
      required(text_key("material", "NAME of a [material.NAME]")),
      other_key("box", "a table {min = [..], max = [..]}", "shape (exactly one of the four)"),
      other_key("disk", "a table {centre = [..], radius = ..}", "shape"),
      other_key("ring", "a table {centre = [..], inner = .., outer = ..}", "shape: between two circles"),
      bounded(other_key("polygon", "a list of three or more vertices, each 2 finite numbers (m)",
                        "shape: closed by itself, not self-intersecting"),
              finite),
      defaulted(bounded(other_key("particles_per_cell", "1, 4, 9 or 16", "n x n particles in each cell"),
                        {1.0, 16.0}),
                "1"),
      defaulted(list_key("velocity", 2, finite, "m/s", "initial velocity at the origin"), "[0.0, 0.0]"),
      defaulted(bounded(other_key("velocity_gradient", "2 rows of 2 finite numbers (1/s)",
                                  "initial velocity = `velocity` + gradient x position"),
                        finite),
                "[[0.0, 0.0], [0.0, 0.0]]"),
      defaulted(list_key("stress", 4, finite, "Pa",
                         "initial stress (rr, zz, tt, rz) or (xx, yy, zz, xy), tension positive"),
                "[0.0, 0.0, 0.0, 0.0]"),
      other_key("perturbation", "a table {amplitude = .., seed = ..}",
                "random displacements of the particles, for ensembles; absent: none"),
  };
  return keys;
}

KeyTable box() {
  static const std::vector<KeyInfo> keys = box_with(finite);
  return keys;
}

KeyTable disk() {
  static const std::vector<KeyInfo> keys{
      required(list_key("centre", 2, finite, "m", "centre")),
      required(number_key("radius", positive, "m", "radius")),
  };
  return keys;
}

KeyTable ring() {
  static const std::vector<KeyInfo> keys{
      required(list_key("centre", 2, finite, "m", "centre")),
      required(number_key("inner", {0.0, infinite, false, true}, "m", "inner radius")),
      required(number_key("outer", positive, "m", "outer radius")),
  };
  return keys;
}

KeyTable perturbation() {
  static const std::vector<KeyInfo> keys{
      required(number_key("amplitude", {0.0, 0.1}, "cells",
                          "each component of a displacement is uniform between plus and minus this")),
      defaulted(
          bounded(other_key("seed", "an integer from 0 to 1000000000", "another seed, other displacements"),
                  {0.0, 1.0e9}),
          "1"),
  };
  return keys;
}

KeyTable boundary(Geometry geometry) {
  static const std::array<std::vector<KeyInfo>, 2> keys{boundary_keys(Geometry::axisymmetric),
                                                        boundary_keys(Geometry::plane_strain)};
  return keys[static_cast<std::size_t>(geometry)];
}

KeyTable boundary_box() {
  static const std::vector<KeyInfo> keys = box_with(extended);
  return keys;
}

}  // namespace vitrum::scene::keys
