#include "scene/write_scene.hpp"

#include "materials/registry.hpp"
#include "scene/scene_tables.hpp"
#include "scene/write_table.hpp"

namespace vitrum {

std::string resolved_toml(const Scene& scene) {
  return scene::table_text(scene::scene_table(scene.geometry), &scene, scene.formulas, scene.functions);
}

std::string point_toml(const PointScene& point) {
  PointScene written = point;
  StateDefinition& given = written.given.emplace();
  given.elastic_strain = point.state.elastic_strain;
  const std::shared_ptr<const Material> material = make_material(point.material, point.size);
  for (std::size_t k = 0; k < material->columns().size(); ++k)
    given.variables[material->columns()[k].name] = value_of(*material, point.state, k);
  return scene::table_text(scene::point_table(), &written, point.formulas);
}

}  // namespace vitrum
