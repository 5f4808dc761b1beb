#include <fmt/format.h>

#include <cmath>
#include <tuple>

#include "materials/registry.hpp"
#include "scene/checks.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

/// G_bar of eqs. 5, 6 and 8 must fall with the crack density, else damage would stiffen the material in
/// shear. Its slope at zero crack density changes sign where nu^3 + nu^2 + 2 nu = 1 (nu = 0.39265); below,
/// down to nu = -1, G_bar and K_bar fall throughout.
bool damage_admits(double poisson) {
  return ((poisson + 1.0) * poisson + 2.0) * poisson < 1.0;
}

void check_von_mises(const TableView& table, const VonMisesParameters& parameters) {
  for (const char* key : {"yield", "peak", "hardening", "softening"})
    if (!table.sound(key)) return;
  if (parameters.peak < parameters.yield)
    table.fail("peak", fmt::format("at least '{}.yield' ({})", table.path(), number_text(parameters.yield)));
  if (parameters.peak > parameters.yield && parameters.hardening == 0.0)
    table.fail("hardening",
               fmt::format("a number > 0 (Pa), since the peak ({}) above the yield strength ({}) is never "
                           "reached without hardening",
                           number_text(parameters.peak), number_text(parameters.yield)));
}

/// Waves of solids travel at some hundred metres a second to some ten thousand: what is far outside is mostly
/// a value in GPa, MPa or g/cm^3.
void warn_of_wave_speed(const TableView& material, const ElasticParameters& given) {
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
  ElasticParameters compressible = given;
  compressible.poisson = 0.25;
  const bool by_poisson = found > fastest && speed(compressible) <= fastest;
  material.warn(by_poisson ? "poisson" : "young",
                fmt::format("waves travel at {:.4g} m/s in this material, expected {:g} to {:g} m/s{}", found,
                            slowest, fastest, by_poisson ? "" : meant));
}

/// A registered law stands alone, and its keys agree with each other.
void check_law(const TableView& table, const MaterialParameters& material) {
  std::string_view named;
  for (const RegisteredLaw& law : registered_laws()) {
    if (!table.has(law.table)) continue;
    if (!named.empty())
      table.report(law.table,
                   fmt::format("found together with '{}', expected only one law in a material", named));
    named = law.table;
  }
  for (const std::string_view model : {"damage", "drucker_prager", "von_mises", "decohesion"})
    if (table.has(model))
      table.report(model,
                   fmt::format("found together with '{}', expected no other model in the material", named));
  const RegisteredLaw& law = *find_law(material.law->table);
  for (const std::string_view key : {std::string_view(law.table), std::string_view("density"),
                                     std::string_view("young"), std::string_view("poisson")})
    if (!table.sound(key)) return;
  if (const auto fault = law.contradiction(material))
    table.table(law.table)->fail(fault->key, fault->expected);
}

/// What a strength is that lies outside of what solids have, or could have with this modulus; MPa for Pa.
void warn_of_strength(const TableView& table, std::string_view key, double found, double least, double most,
                      std::string_view unit) {
  if ((found >= least && found <= most) || found == 0.0) return;
  const bool slip = 1e6 * found >= least && 1e6 * found <= most;
  table.warn(key, fmt::format("found {:g} {}, expected {:.3g} to {:.3g}{}", found, unit, least, most,
                              slip ? fmt::format("; did you mean {:g}e6?", found) : ""));
}

void warn_of_strengths(const TableView& table, const MaterialParameters& material) {
  constexpr double softest = 1e-6, strongest = 0.2;  // of Young's modulus
  const double least = softest * material.elastic.young, most = strongest * material.elastic.young;
  if (material.damage)
    warn_of_strength(*table.table("damage"), "toughness", material.damage->toughness, 1e4, 1e9, "Pa sqrt(m)");
  if (material.von_mises)
    warn_of_strength(*table.table("von_mises"), "yield", material.von_mises->yield, least, most, "Pa");
  if (!material.drucker_prager) return;
  // What has no cohesion is written with next to none. Only what is a usual strength in MPa is told.
  const double yield = material.drucker_prager->yield, in_mega = 1e6 * yield / material.elastic.young;
  if (yield >= least || (in_mega >= 1e-4 && in_mega <= 0.05))
    warn_of_strength(*table.table("drucker_prager"), "yield", yield, least, most, "Pa");
}

/// What bears a separated point, and what that asks of other keys.
void check_separated(const TableView& material, const MaterialParameters& given) {
  const TableView table = *material.table("decohesion");
  if (!table.sound("separated")) return;
  const Separated separated = given.decohesion->separated;
  if (separated != Separated::faces && table.sound("friction") && given.decohesion->friction > 0.0)
    table.fail("friction", "0, or separated = \"faces\": nothing else rubs");
  if (separated != Separated::drucker_prager) return;
  if (!given.drucker_prager)
    table.fail(
        "separated",
        fmt::format("another value, or a table [{}.drucker_prager], whose beta rubble has", material.path()));
  else if (const TableView pressed = *material.table("drucker_prager");
           pressed.sound("beta") && !(given.drucker_prager->beta > 0.0))
    pressed.fail("beta",
                 "a number > 0, as rubble of decohesion.separated = \"drucker-prager\" has no other "
                 "strength");
}

void check_material(const TableView& table, const MaterialParameters& material) {
  if (table.sound("density") && table.sound("young") && table.sound("poisson"))
    warn_of_wave_speed(table, material.elastic), warn_of_strengths(table, material);
  if (material.damage && table.sound("poisson") && !damage_admits(material.elastic.poisson))
    table.fail("poisson",
               "a number < 0.3926 in a material with damage (above, eqs. 5, 6 and 8 make the shear "
               "modulus rise with damage)");
  if (material.von_mises) check_von_mises(*table.table("von_mises"), *material.von_mises);
  if (table.has("drucker_prager") && table.has("von_mises"))
    table.report("von_mises",
                 "found together with 'drucker_prager', expected only one plasticity model in a material");
  if (material.decohesion) check_separated(table, material);
  if (material.law) check_law(table, material);
}

}  // namespace

void check_materials(const TableView& document, const std::vector<MaterialParameters>& materials) {
  const std::vector<TableView> tables = document.tables("material");
  for (std::size_t i = 0; i < materials.size(); ++i) check_material(tables[i], materials[i]);
}

}  // namespace vitrum::scene
