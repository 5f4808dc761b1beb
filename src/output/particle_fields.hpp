#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mpm/particles.hpp"
#include "output/output_frame.hpp"
#include "scene/scene.hpp"

namespace vitrum::output {

/// The fields that particles of these materials can be written with: position, velocity, stress, damage (when
/// a material has a damage model), the materials' columns in the order of all_columns(), and
/// elastic_strain.
std::vector<std::string> known_fields(std::span<const Material* const> materials);

/// The fields that a run writes. `requested`: the scene's output.fields; none gives all known fields but
/// elastic_strain, which the stress and the other variables determine. position is always among them: nothing
/// can be drawn without it. Throws InputError listing the known names when a requested field is none of them;
/// `where` begins its message.
std::vector<std::string> select_fields(const std::optional<std::vector<std::string>>& requested,
                                       std::span<const Material* const> materials, std::string_view where);
/// The same for the scene, whose bodies have these materials.
std::vector<std::string> select_fields(const Scene& scene, std::span<const Material* const> materials);

/// Numbers a particle that a field has.
std::size_t components_of(std::string_view field);

/// The materials of bodies, one per body.
std::vector<const Material*> materials_of(std::span<const Body> bodies);

/// The named fields (from select_fields) of all particles: body after body, within a body by rising identity,
/// so that a row is the same particle at every output. A variable that a body's material does not have is NaN
/// there: 0 would say "measured, and intact".
std::vector<Field> particle_fields(std::span<const Body> bodies, std::span<const std::string> names,
                                   Geometry geometry);

/// Values of all particles in the same order, of columns in storage order for each body; none for no columns.
std::vector<double> in_rows(std::span<const Body> bodies, std::span<const std::vector<double>> columns);

/// Body index, mass and size of all particles in the same order; axisymmetric masses are those of whole
/// rings.
ParticleConstants particle_constants(std::span<const Body> bodies, Geometry geometry);

}  // namespace vitrum::output
