#include "app/failed_point.hpp"

#include "app/point_path.hpp"
#include "catch.hpp"
#include "mpm/point.hpp"
#include "scene/read_scene.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// A damaging body whose first particle has been stretched; as if then an increment had failed there.
Scene stretched_scene() {
  MpmScene scene;
  scene.density = 2500.0, scene.young = 72.0e9;
  scene.tables = body("plate", box({0.0, 0.0}, {2.0, 2.0})) +
                 "[material.elastic.damage]\ntoughness = 0.83e6\nk = 5.0e26\nm = 6\n";
  return parse_scene(scene.text(), "test.toml");
}

}  // namespace

TEST_CASE("A failed increment, also one that takes no time, is replayed as it was", "[app]") {
  const Scene scene = stretched_scene();
  for (const double duration : {0.0, 2.0e-7}) {
    MpmRun run(scene);
    const Material& material = *run.system.bodies[0].material;
    PointState state = material.start({});
    PointReport report;
    material.advance(state, {4.0e-4, 1.0e-4, 0.0, 1.0e-4}, 1.0e-6, report);
    mpm::put_point(state, run.system.bodies[0], 0);

    const SymmetricTensor increment{1.0e-4, 0.0, 5.0e-5, 0.0};
    const std::string text =
        app::failed_point(scene, run.system, PointFailure("", 0, 0, increment, duration));
    material.advance(state, increment, duration, report);
    const PointScene point = parse_point(text, "failed_point.toml", {});
    const auto replayed = make_material(point.material, point.size);
    PointState end;
    app::follow_path(
        point, *replayed,
        {[&](double, const SymmetricTensor&, const PointState& s) { end = s; }, [](EventKind, double) {}});
    CAPTURE(duration, text);
    const std::size_t density = *material.column("crack_density");
    CHECK(state.variables[density] > 0.0);
    CHECK(end.variables[density] == Approx(state.variables[density]).epsilon(1e-13));
    CHECK(norm(end.stress - state.stress) <= 1e-12 * norm(state.stress));
  }
}
