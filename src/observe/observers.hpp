#pragma once
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "observe/observer.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// The observers of a run: those of the registry that its scene has something to see for.
class Observers {
 public:
  Observers(const Scene& scene, const System& system);

  /// A step, seen by all (0 s: the start); rows that are due are told.
  void step(const System& system, double duration);
  /// The state at an output, for tables without an interval of their own; and the last state, for all.
  void tell_output(const System& system);
  void tell_last(const System& system);

  std::vector<Quantity> quantities(const System& system) const;
  void save(Archive& archive) const;
  void restore(const Archive& archive);

  std::vector<Table*> tables() const;
  /// The observer of a type. std::logic_error: there is none.
  template <class Type>
  Type& get() const {
    for (const Seat& seat : seats_)
      if (auto* found = dynamic_cast<Type*>(seat.observer.get())) return *found;
    throw std::logic_error("the run lacks an observer");
  }

 private:
  struct Seat {
    std::unique_ptr<Observer> observer;
    std::int64_t told = -1;  ///< step whose rows its table has; -1: none
  };
  static void tell(const System& system, Seat& seat);

  std::vector<Seat> seats_;
};

}  // namespace vitrum
