#include "output/particle_fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "materials/registry.hpp"
#include "mpm/stress.hpp"
#include "scene/input_error.hpp"

namespace vitrum::output {
namespace {

constexpr double not_modelled = std::numeric_limits<double>::quiet_NaN();

/// Storage indices of a body's particles by rising identity.
std::vector<std::size_t> identity_order(const Particles& particles) {
  std::vector<std::size_t> order(particles.size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (particles.identity.empty()) return order;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return particles.identity[a] < particles.identity[b]; });
  return order;
}

/// For each body, its particles in the order of rows.
using Rows = std::vector<std::vector<std::size_t>>;

Rows rows_of(std::span<const Body> bodies) {
  Rows rows;
  for (const Body& body : bodies) rows.push_back(identity_order(body.particles));
  return rows;
}

std::size_t count(const Rows& rows) {
  std::size_t sum = 0;
  for (const auto& body : rows) sum += body.size();
  return sum;
}

/// Rows whose components are read from columns of every body.
template <std::size_t components, class Columns>
Field gather(std::span<const Body> bodies, const Rows& rows, const Columns& columns_of) {
  Field field;
  field.components = components;
  field.values.reserve(components * count(rows));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::array<std::vector<double>, components>& columns = columns_of(bodies[b]);
    for (const std::size_t index : rows[b])
      for (const std::vector<double>& column : columns) field.values.push_back(column[index]);
  }
  return field;
}

/// One value a particle; not_modelled for bodies that `has` denies.
template <class Has, class Value>
Field gather_scalar(std::span<const Body> bodies, const Rows& rows, const Has& has, const Value& value) {
  Field field;
  field.values.reserve(count(rows));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const bool present = has(bodies[b]);
    for (const std::size_t index : rows[b])
      field.values.push_back(present ? value(bodies[b], index) : not_modelled);
  }
  return field;
}

Field named(Field field, std::string name, std::string unit, std::string description) {
  field.name = std::move(name), field.unit = std::move(unit), field.description = std::move(description);
  return field;
}

bool has_damage(const Material& material) {
  return material.damage_column().has_value();
}

Field column_field(std::span<const Body> bodies, const Rows& rows, const Component& column) {
  return named(
      gather_scalar(
          bodies, rows, [&](const Body& body) { return body.material->column(column.name).has_value(); },
          [&](const Body& body, std::size_t index) {
            return body.particles.variables[*body.material->column(column.name)][index];
          }),
      column.name, column.unit, column.text + "; NaN: not modelled");
}

Field field_of(std::span<const Body> bodies, const Rows& rows, const std::string& name, Geometry geometry) {
  const bool axisymmetric = geometry == Geometry::axisymmetric;
  const std::string vector = axisymmetric ? "(r, z)" : "(x, y)";
  const std::string tensor = axisymmetric ? "(rr, zz, tt, rz)" : "(xx, yy, zz, xy)";
  if (name == "position")
    return named(gather<2>(
                     bodies, rows, [](const Body& b) -> auto& { return b.particles.position; }),
                 name, "m", "position " + vector);
  if (name == "velocity")
    return named(gather<2>(
                     bodies, rows, [](const Body& b) -> auto& { return b.particles.velocity; }),
                 name, "m/s", "velocity " + vector);
  if (name == "stress")
    return named(
        gather<4>(bodies, rows, mpm::stress_of), name, "Pa",
        "stress, force per area of the unstrained material (Kirchhoff's) " + tensor + ", tension positive");
  if (name == "elastic_strain")
    return named(gather<4>(
                     bodies, rows, [](const Body& b) -> auto& { return b.particles.elastic_strain; }),
                 name, "1", "elastic strain " + tensor + ", tensor shear");
  if (name == "damage")
    return named(
        gather_scalar(
            bodies, rows, [](const Body& body) { return has_damage(*body.material); },
            [](const Body& body, std::size_t index) {
              return body.material->damage(body.particles.variables[*body.material->damage_column()][index]);
            }),
        name, "1", "damage D = 1 - K_bar/K, eq. 8; NaN: not modelled");
  for (const Component& column : all_columns())
    if (column.name == name) return column_field(bodies, rows, column);
  throw std::invalid_argument(fmt::format("no field is called '{}'", name));
}

}  // namespace

std::vector<std::string> known_fields(std::span<const Material* const> materials) {
  std::vector<std::string> names = {"position", "velocity", "stress"};
  if (std::any_of(materials.begin(), materials.end(), [](const Material* m) { return has_damage(*m); }))
    names.emplace_back("damage");
  for (const Component& column : all_columns())
    if (std::ranges::find(names, column.name) == names.end() &&
        std::any_of(materials.begin(), materials.end(),
                    [&](const Material* m) { return m->column(column.name).has_value(); }))
      names.push_back(column.name);
  names.emplace_back("elastic_strain");
  return names;
}

std::size_t components_of(std::string_view field) {
  if (field == "position" || field == "velocity") return 2;
  return field == "stress" || field == "elastic_strain" ? 4 : 1;
}

std::vector<std::string> select_fields(const std::optional<std::vector<std::string>>& requested,
                                       std::span<const Material* const> materials, std::string_view where) {
  std::vector<std::string> known = known_fields(materials);
  if (!requested) {
    std::erase(known, "elastic_strain");
    return known;
  }
  std::vector<std::string> faults, selected = {"position"};
  for (const std::string& name : *requested) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      faults.push_back(fmt::format("{}: found \"{}\", expected fields that this scene's materials have: {}",
                                   where, name, fmt::join(known, ", ")));
    else if (std::find(selected.begin(), selected.end(), name) == selected.end())
      selected.push_back(name);
  }
  if (!faults.empty()) throw InputError(faults);
  return selected;
}

std::vector<std::string> select_fields(const Scene& scene, std::span<const Material* const> materials) {
  return select_fields(scene.output.fields, materials, scene.at("output.fields"));
}

std::vector<const Material*> materials_of(std::span<const Body> bodies) {
  std::vector<const Material*> materials;
  for (const Body& body : bodies) materials.push_back(body.material.get());
  return materials;
}

std::vector<Field> particle_fields(std::span<const Body> bodies, std::span<const std::string> names,
                                   Geometry geometry) {
  const Rows rows = rows_of(bodies);
  std::vector<Field> fields;
  for (const std::string& name : names) fields.push_back(field_of(bodies, rows, name, geometry));
  return fields;
}

std::vector<double> in_rows(std::span<const Body> bodies, std::span<const std::vector<double>> columns) {
  std::vector<double> values;
  for (std::size_t b = 0; b < columns.size(); ++b)
    for (const std::size_t index : identity_order(bodies[b].particles)) values.push_back(columns[b][index]);
  return values;
}

ParticleConstants particle_constants(std::span<const Body> bodies, Geometry geometry) {
  ParticleConstants constants;
  const double factor = geometry == Geometry::axisymmetric ? 2.0 * std::numbers::pi : 1.0;
  constants.mass_unit = geometry == Geometry::axisymmetric ? "kg" : "kg/m";
  for (const Body& body : bodies) {
    const auto index = static_cast<std::uint32_t>(constants.bodies.size());
    constants.bodies.push_back(body.name);
    for (const std::size_t particle : identity_order(body.particles)) {
      constants.body.push_back(index);
      constants.mass.push_back(factor * body.particles.mass[particle]);
      constants.size.push_back(2.0 * body.particle_half_size);
    }
  }
  return constants;
}

}  // namespace vitrum::output
