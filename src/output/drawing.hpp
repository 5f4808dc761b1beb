#pragma once
#include <string>
#include <vector>

#include "output/output_frame.hpp"

namespace vitrum::output {

/// A quantity of a body's particles as visualisation programs want it: numbers (1 component), vectors (3: x,
/// y, 0) or symmetric tensors (6: xx, yy, zz, xy, yz, xz, the order of VTK). Axisymmetric: x = r, y = z, zz =
/// the hoop's.
struct DrawnArray {
  std::string name;
  std::size_t components = 1;
  std::vector<double> values;  ///< particles x components, row-major
  bool constant = false;       ///< the same at every output
};

/// What is drawn of one body: a block of its own, with its name.
struct DrawnBody {
  std::string name;
  std::size_t particles = 0;
  std::vector<DrawnArray> arrays;
};

/// Mass and size of the particles.
std::vector<DrawnBody> drawn_constants(const ParticleConstants& constants);

/// Those, and all fields of the output: `normal` in the place of its two components; pressure and von Mises
/// stress where there is stress; the fragment. Nothing for an output without positions.
std::vector<DrawnBody> drawing(const OutputFrame& frame, const ParticleConstants& constants);

}  // namespace vitrum::output
