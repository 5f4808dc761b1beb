// Point files, under each of the three local methods.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "app/point_path.hpp"
#include "promises.hpp"
#include "scene/read_scene.hpp"
#include "scene/write_scene.hpp"

namespace vitrum::fuzz {
namespace {

constexpr std::size_t most_segments = 6;
constexpr int most_increments = 24;

void demand_same_when_resolved(const PointScene& point) {
  const std::string resolved = point_toml(point);
  PointScene again = parse_point(resolved, "resolved.toml");
  again.formulas = point.formulas;  // comments, which are not read
  demand(point_toml(again) == resolved,
         "the resolved point reads as the same point");
}

/// The first segments, in few increments each.
PointScene shortened(PointScene point) {
  point.time.resize(std::min(point.time.size(), most_segments + 1));
  point.strain.resize(point.time.size());
  point.samples = std::min(point.samples, most_increments / static_cast<int>(point.time.size() - 1));
  return point;
}

void drive(const PointScene& point) {
  const std::shared_ptr<const Material> material = make_material(point.material, point.size);
  app::follow_path(point, *material,
                   {[&](double time, const SymmetricTensor&, const PointState& state) {
                      demand(std::isfinite(time) && std::isfinite(trace(state.stress) + state.stress.rz),
                             "rows are finite");
                      for (std::size_t k = 0; k < material->columns().size(); ++k)
                        demand(!std::isnan(value_of(*material, state, k)),
                               "variables are numbers: " + material->columns()[k].name);
                    },
                    [](EventKind, double time) { demand(std::isfinite(time), "events have a time"); }});
}

}  // namespace
}  // namespace vitrum::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrum;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::tolerate_refusal([&] {
    PointScene point = parse_point(text, "point.toml");
    fuzz::demand_same_when_resolved(point);
    point = fuzz::shortened(std::move(point));
    for (const LocalMethod method : {LocalMethod::closed_form, LocalMethod::substep, LocalMethod::cvode}) {
      point.constitutive.method = method;
      fuzz::tolerate_refusal([&] { fuzz::drive(point); });
    }
  });
  return 0;
}
