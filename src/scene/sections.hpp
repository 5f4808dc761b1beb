#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"
#include "scene/toml_reader.hpp"

/// Readers of the parts of a document. Each reports its faults to the reader's diagnostics and fills what it
/// could read.
namespace vitrum::scene {

void read_space(const TableReader& document, Scene& scene);
void read_time(const TableReader& document, Scene& scene);
void read_gravity(const TableReader& document, Scene& scene);
/// Reads scene.output; needs scene.start and scene.end.
void read_output(const TableReader& document, Scene& scene);
/// Reads scene.integrator; needs scene.start and scene.end.
void read_integrator(const TableReader& document, Scene& scene);
void read_constitutive(const TableReader& document, ConstitutiveDefinition& constitutive);

/// Every [material.NAME], in the order of the file; those that only --set names come last.
std::vector<MaterialParameters> read_materials(const TableReader& document);

/// Reads scene.bodies; needs scene.geometry and scene.materials.
void read_bodies(const TableReader& document, Scene& scene);
/// Reads scene.boundaries; needs scene.geometry.
void read_boundaries(const TableReader& document, Scene& scene);
/// Reads scene.contact; needs scene.bodies.
void read_contact(const TableReader& document, Scene& scene);

/// Reports an interval (s) that fits into the scene's duration more than 1e12 times: such a run would not
/// end, and far beyond it the intervals can no longer be counted.
void require_countable(const TableReader& table, std::string_view key, const std::optional<double>& interval,
                       const Scene& scene);

/// Reads [path] of a point file.
/// [state] of a point file.
void read_state(const TableReader& document, PointScene& point);
void read_path(const TableReader& document, PointScene& point);

}  // namespace vitrum::scene
