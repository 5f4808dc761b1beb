#include <optional>

#include "materials/composite/mode_problem.hpp"

namespace vitrum {
namespace {

class CompositeCourse final : public Course {
 public:
  CompositeCourse(const CompositeModes& law, const PointState& start, const StrainPath& path,
                  PointReport& report)
      : law_(law), path_(path), state_(law.load(start)), mode_(law.first_mode(state_, path, report)) {
    find_direction();
  }

  bool evolves() const override { return mode_.evolves(); }

  void guards_ahead(double fraction, Guards& guards) const override {
    law_.guards(mode_, along(fraction), path_, guards);
  }
  void move(double fraction) override { state_ = along(fraction); }

  const ModeEquations& equations(double fraction) override {
    return problem_.emplace(law_, mode_, path_, state_, fraction);
  }
  double follow(double parameter, const double* y, Dissipation& dissipation) override {
    dissipation += problem_->dissipation(y);
    const double fraction = problem_->fraction(parameter, y);
    const CompositeState next = problem_->state(parameter, y);  // the problem looks at state_
    state_ = next;
    law_.project(mode_, state_, path_);
    return fraction;
  }

  void transition(Guard guard, double fraction, PointReport& report) override {
    law_.transition(mode_, static_cast<CompositeGuard>(guard), state_, path_, fraction, report);
    find_direction();
  }
  void put(PointState& point) const override {
    law_.store(state_, point);
    point.stress = law_.secant_moduli(state_).stress(state_.elastic_strain);
  }

 private:
  /// Of a mode without curved evolution.
  void find_direction() {
    if (!mode_.evolves()) direction_ = law_.rates(mode_, state_, path_);
  }
  CompositeState along(double fraction) const {
    CompositeState s = state_;
    s.elastic_strain += fraction * direction_.elastic_strain;
    s.opening_n += fraction * direction_.opening_n;
    s.opening_t += fraction * direction_.opening_t;
    s.plastic_strain += fraction * direction_.plastic_strain;
    return s;
  }

  const CompositeModes& law_;
  const StrainPath& path_;
  CompositeState state_;
  CompositeMode mode_;
  CompositeRates direction_;
  std::optional<ModeProblem> problem_;
};

}  // namespace

Course& CompositeModes::enter(CourseRoom& room, const PointState& point, const StrainPath& path,
                              PointReport& report) const {
  return room.emplace<CompositeCourse>(*this, point, path, report);
}

}  // namespace vitrum
