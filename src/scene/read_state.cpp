#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

#include "scene/scene_keys.hpp"
#include "scene/sections.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

double value(const PointState& s, Variable v) {
  return s.*variable_members[static_cast<std::size_t>(v)];
}
std::string_view name(Variable v) {
  return all_variables()[static_cast<std::size_t>(v)].name;
}

/// Reports the first of `variables` that is not zero.
bool require_zero(const TableReader& table, const PointState& s, std::span<const Variable> variables,
                  std::string_view because) {
  for (const Variable v : variables)
    if (value(s, v) != 0.0) {
      table.fail(name(v), fmt::format("0: {}", because));
      return false;
    }
  return true;
}

/// What a model that the material does not name would keep.
bool check_models(const TableReader& table, const PointScene& point) {
  using enum Variable;
  static constexpr std::array damaging{crack_density, max_rate};
  static constexpr std::array flowing{plastic_strain};
  static constexpr std::array cohesive{decohesion, opening_n,        opening_t,        normal_r,
                                       normal_z,   effective_length, cohesive_strength};
  const MaterialParameters& m = point.material;
  return (m.damage || require_zero(table, point.state, damaging, "the material has no damage")) &&
         (m.von_mises || m.drucker_prager ||
          require_zero(table, point.state, flowing, "the material has no yield surface")) &&
         (m.decohesion || require_zero(table, point.state, cohesive, "the material has no decohesion"));
}

/// What a plane keeps that is not there: a point is localised where it has an effective length.
bool check_intact(const TableReader& table, const PointState& s) {
  using enum Variable;
  static constexpr std::array of_a_plane{decohesion, opening_n, opening_t,
                                         normal_r,   normal_z,  cohesive_strength};
  return require_zero(table, s, of_a_plane,
                      "the point is not localised (it would have an effective_length > 0)");
}

void check_plane(const TableReader& table, const PointScene& point) {
  constexpr double rounding = 1e-6;  // of a plane that has turned with its particle
  using enum Variable;
  const PointState& s = point.state;
  const double length = std::hypot(s.normal_r, s.normal_z);
  const bool hoop = s.normal_r == 0.0 && s.normal_z == 0.0;
  if (!hoop && !(std::abs(length - 1.0) <= rounding)) {
    table.report(table.has("normal_r") ? "normal_r" : "normal_z",
                 fmt::format("found a normal ({}, {}) of length {:.6g}, expected a unit vector",
                             number_text(s.normal_r), number_text(s.normal_z), length));
  } else if (hoop && !point.material.decohesion->search_all_planes) {
    table.report(
        "effective_length",
        "found a localised point without a normal (normal_r, normal_z), which is that of a hoop plane; "
        "expected a unit vector, or decohesion.plane = \"all\"");
  } else if (s.decohesion < 1.0 && !(s.cohesive_strength > 0.0)) {
    table.report(
        "cohesive_strength",
        fmt::format("found {} on a plane that has not separated, expected the traction at its onset (> 0)",
                    number_text(s.cohesive_strength)));
  } else if (s.opening_n < -rounding * point.material.decohesion->opening) {
    table.fail("opening_n", "at least 0: faces do not penetrate");
  } else if (hoop && s.opening_t != 0.0) {
    table.fail("opening_t", "0: a hoop plane does not slide");
  } else if (s.decohesion == 0.0) {
    static constexpr std::array openings{opening_n, opening_t};
    require_zero(table, s, openings, "decohesion is 0, and openings are what it brings");
  }
}

}  // namespace

void read_state(const TableReader& document, PointScene& point) {
  const auto table = document.table("state", keys::state());
  if (!table) return;
  std::array<double, 4> e{};
  if (table->read("elastic_strain", std::span<double>(e)))
    point.state.elastic_strain = {e[0], e[1], e[2], e[3]};
  for (const VariableInfo& v : all_variables())
    table->read(v.name, point.state.*variable_members[static_cast<std::size_t>(v.variable)]);
  if (!check_models(*table, point)) return;
  if (is_localised(point.state))
    check_plane(*table, point);
  else
    check_intact(*table, point.state);
}

}  // namespace vitrum::scene
