#pragma once
#include <numbers>
#include <string>
#include <vector>

#include "mpm/system.hpp"
#include "observe/archive.hpp"
#include "observe/table.hpp"

namespace vitrum {

/// A quantity of the whole run at an output: one number of the series of result.h5.
struct Quantity {
  std::string name;  ///< dataset below /series; not "time" or "step_index", which every output has anyway
  std::string unit;
  std::string description;
  double value;
};

/// What turns quantities of a system into those that files show: per radian becomes whole body.
inline double whole_body(const System& system) {
  return system.axisymmetric ? 2.0 * std::numbers::pi : 1.0;
}

/// Looks on while a system is computed, and tells what it saw. It changes nothing: a run has the same bits
/// whoever looks on. A new one is a file pair and a line in registry.cpp (docs/howto/development.md).
class Observer {
 public:
  virtual ~Observer() = default;
  /// Sees an accepted step of `duration` seconds; system.record says what it did. First called, with 0, for
  /// the start.
  virtual void step(const System& /*system*/, double /*duration*/) {}
  /// Enters the rows of the present moment into its table.
  virtual void tell(const System& /*system*/) {}
  /// Adds the quantities that it knows at an output.
  virtual void declare(const System& /*system*/, std::vector<Quantity>& /*quantities*/) const {}
  /// What it must remember to go on from a checkpoint; its table takes care of itself.
  virtual void save(Archive& /*archive*/) const {}
  virtual void restore(const Archive& /*archive*/) {}
  /// The table that it fills; null: none.
  virtual Table* table() { return nullptr; }
};

}  // namespace vitrum
