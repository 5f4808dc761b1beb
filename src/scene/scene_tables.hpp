#pragma once
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "schema/table.hpp"

/// The tables of scene and point files, a row a key: what reading, `--set`, the resolved scene, the
/// reference, the JSON schema and the words of the fuzz targets are made from.
namespace vitrum::scene {

/// A scene file. The names in `boundary.fix` depend on the geometry.
const schema::Table& scene_table(Geometry geometry);
const schema::Table& point_table();

// Parts of them, in files by subject.
const schema::Table& space_table();
const schema::Table& time_table();
const schema::Table& output_table();
const schema::Table& gravity_table();
const schema::Table& traction_box_table();
const schema::Table& traction_table();
const schema::Table& body_table();
const schema::Table& boundary_table(Geometry geometry);
const schema::Table& contact_table();
const schema::Table& probe_table();
const schema::Table& probe_box_table();
const schema::Table& material_table();

/// Names that `output.fields` admits.
const std::vector<std::string>& output_fields();

}  // namespace vitrum::scene
