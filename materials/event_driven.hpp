#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <utility>

#include "materials/law.hpp"

/// A law as an ordinary differential equation. Over an increment the strain runs along a straight line; the
/// point is in one mode (active set) at a time, in which its rates are smooth; a mode ends where one of its
/// guards crosses zero, and a transition leads to the next. What modes, guards and unknowns are, the law
/// alone knows; the integrators of integrators/local see numbers.
namespace vitrum {

/// A straight strain path, followed by its fraction in [0, 1].
struct StrainPath {
  SymmetricTensor strain;  ///< whole increment
  double duration = 0.0;   ///< s
  double tolerance = 0.0;  ///< relative error with which the state along it is known
};

/// The law's number of what ended a mode.
using Guard = int;
/// The end of the path: a guard of modes in which the fraction of the path is an unknown.
inline constexpr Guard path_end = -1;

/// The guards of a mode, scaled to O(1): below zero inside the mode, crossing zero upwards where it ends.
struct Guards {
  static constexpr std::size_t capacity = 13;
  Guards() {}  // entries beyond count are not set
  std::array<Guard, capacity> guard;
  std::array<double, capacity> value;
  std::size_t count = 0;

  /// name: a number, or an enumeration of the law.
  template <class Name>
  void add(Name name, double v) {
    guard[count] = static_cast<Guard>(name), value[count++] = v;
  }
};

/// The equations of one mode as a system y' = f(parameter, y) with y scaled to O(1): only what the mode
/// changes is an unknown. The parameter starts at 0 and runs to `parameter_end`, or to the guard `path_end`.
class ModeEquations {
 public:
  static constexpr std::size_t most_unknowns = 16;

  virtual ~ModeEquations() = default;
  virtual std::size_t size() const = 0;
  virtual double parameter_end() const = 0;
  /// Longest sensible step.
  virtual double parameter_scale() const = 0;
  /// Whether the rates relax much faster than the path goes.
  virtual bool stiff() const = 0;
  virtual void initial(double* y) const = 0;
  /// Writes size() rates. False where they are not finite.
  virtual bool rates(double parameter, const double* y, double* rates) const = 0;
  /// d(rates)/dy by columns, size() x size(), where the law gives it in closed form.
  virtual bool has_jacobian() const = 0;
  virtual void jacobian(double parameter, const double* y, double* columns) const = 0;
  virtual void guards(double parameter, const double* y, Guards& guards) const = 0;
  /// Drift correction: moves y onto the surfaces that the mode keeps to.
  virtual void project(double parameter, double* y) const = 0;
  /// Error admitted in each unknown besides `relative` |y|.
  virtual void absolute_tolerances(double relative, double absolute, double* tolerances) const = 0;
  /// Name of an unknown, for messages.
  virtual const char* name(std::size_t unknown) const = 0;
};

/// A point on its way along a path.
class Course {
 public:
  virtual ~Course() = default;
  /// Whether the present mode follows equations; otherwise the state moves along a straight line.
  virtual bool evolves() const = 0;

  /// Of a straight mode: its guards `fraction` of the path further, and the way there.
  virtual void guards_ahead(double fraction, Guards& guards) const = 0;
  virtual void move(double fraction) = 0;

  /// Of a mode that evolves, from `fraction` of the path on; valid until the next call of `follow`.
  virtual const ModeEquations& equations(double fraction) = 0;
  /// Takes the solution of these equations; adds what it dissipated, and gives the fraction reached.
  virtual double follow(double parameter, const double* y, Dissipation& dissipation) = 0;

  /// The mode after `guard` ended the present one at `fraction`; performs the jumps that the state then asks
  /// for, and records the events.
  virtual void transition(Guard guard, double fraction, PointReport& report) = 0;
  /// The state where the course stands, with its stress.
  virtual void put(PointState& point) const = 0;
};

/// Where a course lives: without allocation.
class CourseRoom {
 public:
  CourseRoom() {}  // filled by emplace
  ~CourseRoom() {
    if (course_ != nullptr) course_->~Course();
  }
  CourseRoom(const CourseRoom&) = delete;
  CourseRoom& operator=(const CourseRoom&) = delete;

  template <class T, class... Arguments>
  T& emplace(Arguments&&... arguments) {
    static_assert(sizeof(T) <= size);
    T* made = new (bytes_) T(std::forward<Arguments>(arguments)...);
    course_ = made;
    return *made;
  }

 private:
  static constexpr std::size_t size = 2048;
  Course* course_ = nullptr;
  alignas(std::max_align_t) std::byte bytes_[size];
};

/// A law that can be followed so.
class EventDriven {
 public:
  virtual ~EventDriven() = default;
  /// The point at the start of a path, in its first mode. Performs the jumps that the state asks for
  /// (snap-back, excess shear) and books them. path must outlive the course.
  virtual Course& enter(CourseRoom& room, const PointState& point, const StrainPath& path,
                        PointReport& report) const = 0;
};

}  // namespace vitrum
