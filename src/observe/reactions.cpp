#include "observe/reactions.hpp"

#include "observe/registry.hpp"

namespace vitrum {
namespace {

constexpr const char* name_of_state = "reactions.impulses";

}  // namespace

std::unique_ptr<Observer> ReactionHistory::make(const Scene& scene, const System& system) {
  if (system.grid.boundaries().empty()) return nullptr;
  auto history = std::make_unique<ReactionHistory>(system);
  history->table_.cadence = history_cadence(scene);
  return history;
}

void ReactionHistory::step(const System& system, double /*duration*/) {
  for (std::size_t k = 0; k < impulses_.size(); ++k) impulses_[k] += system.record.impulses[k];
}

void ReactionHistory::tell(const System& system) {
  const double whole = whole_body(system);
  for (std::size_t n = 0; n < system.grid.boundaries().size(); ++n)
    table_.row(system.time, system.grid.boundaries()[n].name, whole * impulses_[2 * n],
               whole * impulses_[2 * n + 1]);
}

void ReactionHistory::save(Archive& archive) const {
  archive.put(name_of_state, impulses_);
}

void ReactionHistory::restore(const Archive& archive) {
  impulses_ = archive.numbers(name_of_state, impulses_.size());
}

}  // namespace vitrum
