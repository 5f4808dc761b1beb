#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "schema/bounds.hpp"

namespace vitrum {

/// What a stored variable is made of: 1, 2 (r, z) or 4 (rr, zz, tt, rz) components.
enum class Kind { scalar, vector, symmetric };

/// What a mirror does to a variable besides moving its components: nothing, or the sign changes (a slip along
/// a tangent that is the normal turned by +90 degrees).
enum class Parity { even, odd };

/// An internal variable that a law stores of each point. Columns, rotation, reflection, output, checkpoint
/// and the pages that list variables follow from it.
struct Variable {
  std::string name;  ///< of output and checkpoint; components add _r, _z or _rr, _zz, _tt, _rz
  std::string unit;  ///< "1" for pure numbers
  std::string text;  ///< one phrase, with the equation number
  Kind kind = Kind::scalar;
  Parity parity = Parity::even;
  double scale = 1.0;                 ///< magnitude at which it matters (error weights)
  double initial = 0.0;               ///< of each component
  Bounds bounds = intervals::finite;  ///< of each component
};

/// One stored number of a variable: a column of the particles, a field of the result.
struct Component {
  std::string name, unit, text;
  double scale, initial;
  Bounds bounds;
  bool flips;  ///< a mirror across the axis (r -> -r) changes its sign
};

constexpr std::size_t component_count(Kind kind) {
  return kind == Kind::scalar ? 1 : kind == Kind::vector ? 2 : 4;
}
/// The columns of some variables, in order.
std::vector<Component> components_of(std::span<const Variable> variables);

}  // namespace vitrum
