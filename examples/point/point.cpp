// Strains a point of glass until a crack has opened; prints time, strain, stress, damage and events. SI
// units.
#include <materials/law.hpp>

#include <cstdio>

int main() {
  vitrum::MaterialParameters glass{.name = "glass", .elastic = {2500.0, 72.0e9, 0.25}};
  glass.damage = {.toughness = 0.83e6, .k = 5.0e26, .m = 6.0, .rate_floor = 1.0};
  glass.decohesion = {.opening = 5.0e-6, .mode_ratio = 50.0};
  const double cell = 1.0e-3, step = 1.0e-8;
  const auto material = vitrum::make_material(glass, cell);

  const vitrum::SymmetricTensor increment{3.0e-5, 0.0, 0.0, 0.0};  // rr, zz, tt, rz
  vitrum::PointState point = material->start({});
  for (int n = 1; n <= 400; ++n) {
    vitrum::PointReport report;
    material->advance(point, increment, step, report);
    std::printf("%.9g %.9g %.9g %.9g", n * step, n * increment.rr, point.stress.rr, material->damage(point));
    for (const vitrum::Event& event : report.events) std::printf(" %s", event_name(event.kind).data());
    std::printf("\n");
  }
}
