#include "output/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace vitrum::output {
namespace {

/// Rows [first, first + particles) of every particle's values are those of a body.
struct Rows {
  std::size_t first, particles;

  std::span<const double> of(const std::vector<double>& values, std::size_t components) const {
    return std::span(values).subspan(first * components, particles * components);
  }
};

std::vector<Rows> rows_of_bodies(const ParticleConstants& constants) {
  std::vector<Rows> rows;
  std::size_t first = 0;
  for (std::uint32_t body = 0; body < constants.bodies.size(); ++body) {
    const auto end = std::upper_bound(constants.body.begin(), constants.body.end(), body);
    const auto next = static_cast<std::size_t>(end - constants.body.begin());
    rows.push_back({first, next - first});
    first = next;
  }
  return rows;
}

const Field* find(const OutputFrame& frame, std::string_view name) {
  const auto found = std::find_if(frame.fields.begin(), frame.fields.end(),
                                  [name](const Field& field) { return field.name == name; });
  return found == frame.fields.end() ? nullptr : &*found;
}

DrawnArray numbers(std::string name, std::span<const double> values, bool constant = false) {
  return {std::move(name), 1, {values.begin(), values.end()}, constant};
}

DrawnArray vector(std::string name, std::span<const double> pairs) {
  DrawnArray array{std::move(name), 3, {}, false};
  array.values.reserve(pairs.size() / 2 * 3);
  for (std::size_t i = 0; i < pairs.size(); i += 2)
    array.values.insert(array.values.end(), {pairs[i], pairs[i + 1], 0.0});
  return array;
}

/// Of (xx, yy, zz, xy).
DrawnArray tensor(std::string name, std::span<const double> s) {
  DrawnArray array{std::move(name), 6, {}, false};
  array.values.reserve(s.size() / 4 * 6);
  for (std::size_t i = 0; i < s.size(); i += 4)
    array.values.insert(array.values.end(), {s[i], s[i + 1], s[i + 2], s[i + 3], 0.0, 0.0});
  return array;
}

DrawnArray pressure(std::span<const double> s) {
  DrawnArray array{"pressure", 1, {}, false};
  for (std::size_t i = 0; i < s.size(); i += 4) array.values.push_back(-(s[i] + s[i + 1] + s[i + 2]) / 3.0);
  return array;
}

double square(double x) {
  return x * x;
}

DrawnArray von_mises(std::span<const double> s) {
  DrawnArray array{"von_mises", 1, {}, false};
  for (std::size_t i = 0; i < s.size(); i += 4)
    array.values.push_back(
        std::sqrt(0.5 * (square(s[i] - s[i + 1]) + square(s[i + 1] - s[i + 2]) + square(s[i + 2] - s[i])) +
                  3.0 * square(s[i + 3])));
  return array;
}

DrawnArray normal(std::span<const double> r, std::span<const double> z) {
  DrawnArray array{"normal", 3, {}, false};
  for (std::size_t i = 0; i < r.size(); ++i) array.values.insert(array.values.end(), {r[i], z[i], 0.0});
  return array;
}

DrawnArray drawn(const Field& field, Rows rows) {
  const std::span<const double> values = rows.of(field.values, field.components);
  // A place has two coordinates: the third is the reader's.
  if (field.name == "position") return {field.name, 2, {values.begin(), values.end()}, false};
  if (field.components == 2) return vector(field.name, values);
  return field.components == 4 ? tensor(field.name, values) : numbers(field.name, values);
}

}  // namespace

std::vector<DrawnBody> drawn_constants(const ParticleConstants& constants) {
  std::vector<DrawnBody> bodies;
  for (const Rows& rows : rows_of_bodies(constants)) {
    DrawnBody body{constants.bodies[bodies.size()], rows.particles, {}};
    body.arrays.push_back(numbers("mass", rows.of(constants.mass, 1), true));
    body.arrays.push_back(numbers("size", rows.of(constants.size, 1), true));
    bodies.push_back(std::move(body));
  }
  return bodies;
}

std::vector<DrawnBody> drawing(const OutputFrame& frame, const ParticleConstants& constants) {
  if (find(frame, "position") == nullptr) return {};
  const Field *stress = find(frame, "stress"), *normal_r = find(frame, "normal_r"),
              *normal_z = find(frame, "normal_z");
  const bool normals = normal_r != nullptr && normal_z != nullptr;
  std::vector<DrawnBody> bodies = drawn_constants(constants);
  const std::vector<Rows> rows = rows_of_bodies(constants);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    std::vector<DrawnArray>& arrays = bodies[b].arrays;
    for (const Field& field : frame.fields)
      if (!normals || (&field != normal_r && &field != normal_z)) arrays.push_back(drawn(field, rows[b]));
    if (normals) arrays.push_back(normal(rows[b].of(normal_r->values, 1), rows[b].of(normal_z->values, 1)));
    if (stress != nullptr) {
      arrays.push_back(pressure(rows[b].of(stress->values, 4)));
      arrays.push_back(von_mises(rows[b].of(stress->values, 4)));
    }
    if (!frame.fragment.empty()) arrays.push_back(numbers("fragment", rows[b].of(frame.fragment, 1)));
  }
  return bodies;
}

}  // namespace vitrum::output
