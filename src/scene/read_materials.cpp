#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "scene/choices.hpp"
#include "scene/scene_keys.hpp"
#include "scene/sections.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

/// Reads the numbers of a describe() table; true when every one has a valid value.
template <class Parameters>
bool read_parameters(const TableReader& table, Parameters& parameters) {
  bool complete = true;
  for (const ParameterInfo<Parameters>& info : Parameters::describe()) {
    double& value = parameters.*info.member;
    if (!table.has(info.name)) {
      complete = complete && info.fallback.has_value();
      value = info.fallback.value_or(0.0);
    } else if (!table.read(info.name, value)) {
      complete = false;
    }
  }
  return complete;
}

/// G_bar of eqs. 5, 6 and 8 must fall with the crack density, else damage would stiffen the material in
/// shear. Its slope at zero crack density changes sign where nu^3 + nu^2 + 2 nu = 1 (nu = 0.39265); below,
/// down to nu = -1, G_bar and K_bar fall throughout.
bool damage_admits(double poisson) {
  return ((poisson + 1.0) * poisson + 2.0) * poisson < 1.0;
}

void read_rate(const TableReader& table, DamageParameters& damage) {
  const toml::node* rate = table.toml().get("rate");
  if (rate == nullptr) return;
  std::size_t named = 0;
  if (!rate->is_table())
    table.read_choice("rate", named);
  else if (const auto fixed = table.table("rate", keys::fixed_rate()))
    fixed->read("fixed", damage.fixed_rate);
}

std::optional<DamageParameters> read_damage(const TableReader& material, const ElasticParameters& elastic) {
  const auto table = material.table("damage", keys::damage());
  if (!table) return std::nullopt;
  DamageParameters damage;
  read_parameters(*table, damage);
  read_rate(*table, damage);
  if (!damage_admits(elastic.poisson))
    material.fail("poisson",
                  "a number < 0.3926 in a material with damage (above, eqs. 5, 6 and 8 make the shear "
                  "modulus rise with damage)");
  return damage;
}

std::optional<DruckerPragerParameters> read_drucker_prager(const TableReader& material) {
  const auto table = material.table("drucker_prager", keys::drucker_prager());
  if (!table) return std::nullopt;
  DruckerPragerParameters parameters;
  read_parameters(*table, parameters);
  table->read_choice("flow", parameters.associated);
  return parameters;
}

std::optional<VonMisesParameters> read_von_mises(const TableReader& material) {
  const auto table = material.table("von_mises", keys::von_mises());
  if (!table) return std::nullopt;
  VonMisesParameters parameters;
  if (!read_parameters(*table, parameters)) return parameters;
  if (parameters.peak < parameters.yield)
    table->fail("peak",
                fmt::format("at least '{}.yield' ({})", table->path(), number_text(parameters.yield)));
  if (parameters.peak > parameters.yield && parameters.hardening == 0.0)
    table->fail("hardening",
                fmt::format("a number > 0 (Pa), since the peak ({}) above the yield strength ({}) is never "
                            "reached without hardening",
                            number_text(parameters.peak), number_text(parameters.yield)));
  return parameters;
}

std::optional<DecohesionParameters> read_decohesion(const TableReader& material) {
  const auto table = material.table("decohesion", keys::decohesion());
  if (!table) return std::nullopt;
  DecohesionParameters parameters;
  read_parameters(*table, parameters);
  table->read_choice("plane", parameters.search_all_planes);
  return parameters;
}

/// Waves of solids travel at some hundred metres a second to some ten thousand: what is far outside is mostly
/// a value in GPa, MPa or g/cm^3.
void warn_of_wave_speed(const TableReader& material, const ElasticParameters& given) {
  constexpr double slowest = 100.0, fastest = 20e3;
  const auto speed = [](const ElasticParameters& e) {
    return std::sqrt(elastic_moduli(e).p_wave() / e.density);
  };
  const double found = speed(given);
  if (found >= slowest && found <= fastest) return;
  std::string meant;
  for (const auto& [member, key, exponent] :
       {std::tuple(&ElasticParameters::young, "young", 9), std::tuple(&ElasticParameters::young, "young", 6),
        std::tuple(&ElasticParameters::density, "density", 3)}) {
    ElasticParameters other = given;
    other.*member *= std::pow(10.0, exponent);
    // Glass, metals and rock, so that not just any factor will do.
    if (const double c = speed(other); !meant.empty() || c < 1e3 || c > fastest) continue;
    meant = fmt::format("; {} = {:g}: did you mean {:g}e{}?", key, given.*member, given.*member, exponent);
  }
  material.warn("young",
                fmt::format("waves travel at {:.4g} m/s in this material, expected {:g} to {:g} m/s{}", found,
                            slowest, fastest, meant));
}

/// The table of the law that the material names, if any.
std::optional<LawParameters> read_law(const TableReader& material) {
  std::optional<LawParameters> named;
  for (const RegisteredLaw& law : registered_laws()) {
    const auto table = material.table(law.table, keys::law(law));
    if (!table) continue;
    if (named)
      material.report(law.table, fmt::format("found together with '{}', expected only one law in a material",
                                             named->table));
    named = LawParameters{law.table, {}};
    for (const ParameterRow& row : law.parameters) {
      std::vector<double>& value = named->values.emplace_back(1, row.fallback.value_or(0.0));
      if (!row.is_list)
        table->read(row.name, value.front());
      else if (table->read(row.name, value) && value.empty())
        table->fail(row.name, find_key(keys::law(law), row.name).expected);
    }
  }
  return named;
}

MaterialParameters read_material(const TableReader& table, std::string name) {
  MaterialParameters material;
  material.name = std::move(name);
  if (read_parameters(table, material.elastic)) warn_of_wave_speed(table, material.elastic);
  material.damage = read_damage(table, material.elastic);
  material.drucker_prager = read_drucker_prager(table);
  material.von_mises = read_von_mises(table);
  material.decohesion = read_decohesion(table);
  if (table.has("drucker_prager") && table.has("von_mises"))
    table.report("von_mises",
                 "found together with 'drucker_prager', expected only one plasticity model in a material");
  material.law = read_law(table);
  if (material.law)
    for (const std::string_view model : {"damage", "drucker_prager", "von_mises", "decohesion"})
      if (table.has(model))
        table.report(model, fmt::format("found together with '{}', expected no other model in the material",
                                        material.law->table));
  return material;
}

}  // namespace

std::vector<MaterialParameters> read_materials(const TableReader& document) {
  std::vector<MaterialParameters> materials;
  const toml::node* node = document.toml().get("material");
  if (node == nullptr) return materials;
  const toml::table* list = node->as_table();
  if (list == nullptr || list->empty()) {
    document.fail("material", find_key(keys::scene(), "material").expected);
    return materials;
  }
  // toml++ sorts keys by name; the file's order is in their positions, which what comes from --set does not
  // have.
  using Entry = std::pair<toml::source_position, std::string>;
  std::vector<Entry> entries;
  for (const auto& [key, unused] : *list) entries.emplace_back(key.source().begin, std::string(key.str()));
  std::ranges::stable_sort(entries, {}, [](const Entry& entry) {
    return std::tuple(entry.first.line == 0, entry.first.line, entry.first.column);
  });
  for (auto& [position, name] : entries) {
    const std::string path = join_path("material", name);
    const toml::node& entry = *list->get(name);
    if (name.empty() || has_control_characters(name))
      document.diagnostics().add(
          path, entry.source().begin, path,
          fmt::format("found {}, expected a name that is not empty, without line breaks or other control "
                      "characters",
                      name.empty() ? "an empty name" : "control characters in the name"));
    if (const toml::table* table = entry.as_table())
      materials.push_back(read_material({*table, path, keys::material(), document.diagnostics()}, name));
    else
      document.diagnostics().add(
          path, entry.source().begin, path,
          fmt::format("found {}, expected a table [material.NAME]", found_text(entry)));
  }
  return materials;
}

}  // namespace vitrum::scene
