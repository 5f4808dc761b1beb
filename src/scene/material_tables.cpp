#include "materials/registry.hpp"
#include "scene/choices.hpp"
#include "scene/presets.hpp"
#include "scene/scene_tables.hpp"

namespace vitrum::scene {
namespace {

using schema::Field;
using schema::Fields;
using schema::required;
using schema::Table;
using schema::table_of;

/// The numbers of a law, then its keys of other kinds.
template <class Parameters>
Table model_table(std::string_view name, std::string_view text, const Fields<Parameters>& others) {
  Fields<Parameters> rows = Parameters::rows();
  rows.insert(rows.end(), others.begin(), others.end());
  return table_of("[material.NAME." + std::string(name) + ']', text, rows);
}

/// A number that a table may give, 0 where it does not.
Field<DamageParameters> given_number(std::string_view key, double DamageParameters::*member,
                                     std::string_view unit, std::string_view meaning) {
  using P = DamageParameters;
  auto row = Field<P>::of(
      key, {schema::Kind::number}, meaning, schema::Need::optional,
      [member](const P& damage) -> std::optional<schema::Value> {
        if (damage.*member > 0.0) return damage.*member;
        return std::nullopt;
      },
      [member](P& damage, const schema::Value& value) { damage.*member = std::get<double>(value); });
  row.unit = unit;
  row.bounds = intervals::positive;
  return row;
}

const Table& rate_table() {
  using P = DamageParameters;
  static const Table table = [] {
    Table t = schema::in_one_line(table_of<P>(
        "`rate` of damage as a table", "",
        {given_number("fixed", &P::fixed_rate, "1/s", "this rate enters eq. 7 whatever the history"),
         given_number("averaged", &P::averaging_time, "s",
                      "the largest so far of the rate averaged over this time, with weights that fade "
                      "exponentially")}));
    t.alternatives = {{{"fixed", "averaged"}, "rate"}};
    return t;
  }();
  return table;
}

/// A text, or a table that gives the rate or the time that it is averaged over.
Field<DamageParameters> rate_row() {
  using P = DamageParameters;
  const auto is_text = [](const P& damage) { return damage.rate() == damage.history; };
  const auto get = [is_text](const P& damage) -> std::optional<schema::Value> {
    if (!is_text(damage)) return std::nullopt;
    return std::string(schema::name_of(damage_rates, damage.history));
  };
  const auto set = [](P& damage, const schema::Value& value) {
    damage.history =
        std::ranges::find(damage_rates, std::get<std::string>(value), &schema::Named<DamageRate>::name)
            ->value;
    damage.fixed_rate = damage.averaging_time = 0.0;
  };
  auto row = Field<P>::of("rate", {schema::Kind::text},
                          "rate of eps_v that enters eq. 7: the largest so far under tension, that of the "
                          "moment, or the largest of any sign",
                          schema::Need::optional, get, set)
                 .expecting(
                     "\"running-maximum\", \"current\", \"maximum-any-sign\", or a table {fixed = "
                     "RATE} or {averaged = TIME}");
  row.choices = schema::texts_of(damage_rates);
  row.table = &rate_table();
  row.open = [](void* owner, const std::string&) {
    auto* damage = static_cast<P*>(owner);
    damage->history = DamageRate::running_maximum;
    damage->fixed_rate = damage->averaging_time = 0.0;
    return owner;
  };
  row.look = [is_text](const void* damage, std::size_t n) {
    return n == 0 && !is_text(*static_cast<const P*>(damage)) ? damage : nullptr;
  };
  return row;
}

const Table& damage_table() {
  static const Table table = model_table<DamageParameters>(
      "damage",
      "With damage, Poisson's ratio must be below 0.3926 (the root of nu^3 + nu^2 + 2 nu = 1): above, eqs. "
      "5, 6 and 8 make the shear modulus rise with the crack density.",
      {{"strain", &DamageParameters::volumetric, damage_strains,
        "eps_v of eq. 7: the mean strain tr(e)/3, or the volumetric one, tr(e)"},
       {"wave_speed", &DamageParameters::pressure_wave, damage_wave_speeds,
        "c of eq. 7: sqrt(E/rho), that of a bar, or that of pressure waves, sqrt((K + 4G/3)/rho)"},
       rate_row()});
  return table;
}

const Table& drucker_prager_table() {
  static const Table table = model_table<DruckerPragerParameters>(
      "drucker_prager", "Excludes `von_mises`.",
      {{"flow", &DruckerPragerParameters::associated, flows,
        "plastic flow without volume change, or normal to the yield surface"}});
  return table;
}

const Table& von_mises_table() {
  static const Table table = model_table<VonMisesParameters>(
      "von_mises",
      "`peak` is at least `yield`; equal: no hardening branch. `softening` = 0: perfectly plastic from the "
      "peak on. A peak above the yield strength needs `hardening` > 0.",
      {});
  return table;
}

const Table& decohesion_table() {
  static const Table table = model_table<DecohesionParameters>(
      "decohesion", "",
      {{"plane", &DecohesionParameters::search_all_planes, planes,
        "normals searched: in the plane of the scene, or the hoop direction too"},
       {"moduli", &DecohesionParameters::undamaged, cohesive_moduli,
        "E of eq. 10, from localisation on: with the damage reached, or of the virgin material"},
       {"separated", &DecohesionParameters::separated, separated_points,
        "what bears a separated point: two faces, free of traction while open, under pressure and `friction` "
        "once closed; rubble, once its void is closed: pressure alone, or with it shear up to beta P of "
        "`drucker_prager`; nothing; or it is removed, with its mass"}});
  return table;
}

Field<MaterialParameters> law_field(const RegisteredLaw& law) {
  using M = MaterialParameters;
  Field<M> field(law.table, &M::law, law.keys, law.text + "; excludes the models above");
  field.open = [&law](void* material, const std::string&) {
    const LawParameters& own = static_cast<M*>(material)->law.emplace(law.defaults(law.table));
    return const_cast<void*>(law.values(own));  // the material is not constant
  };
  field.look = [&law](const void* material, std::size_t n) -> const void* {
    const auto& parameters = static_cast<const M*>(material)->law;
    return n == 0 && parameters && parameters->table == law.table ? law.values(*parameters) : nullptr;
  };
  return field;
}

/// Presets fill a material before it is read (presets.hpp): the row is for those who ask what a scene may
/// say.
Field<MaterialParameters> preset_row() {
  using M = MaterialParameters;
  auto row = Field<M>::of(
      "preset", {schema::Kind::text},
      "a material of `vitrum reference --materials`: gives every key that the scene does not",
      schema::Need::optional, [](const M&) -> std::optional<schema::Value> { return std::nullopt; },
      [](M&, const schema::Value&) {});
  for (const auto& [name, unused] : presets()) row.choices.emplace_back(name.str());
  return row;
}

}  // namespace

const Table& material_table() {
  using M = MaterialParameters;
  static const Table table = [] {
    Fields<M> rows = schema::joined({}, &M::elastic, ElasticParameters::rows());
    rows.push_back(preset_row());
    const Fields<M> models{
        {"damage", &M::damage, damage_table(), "rate-dependent tensile damage; absent: none"},
        {"drucker_prager", &M::drucker_prager, drucker_prager_table(),
         "plasticity under compression; absent: none"},
        {"von_mises", &M::von_mises, von_mises_table(),
         "plasticity with hardening and softening; absent: none; excludes `drucker_prager`"},
        {"decohesion", &M::decohesion, decohesion_table(), "from localisation to separation; absent: none"}};
    rows.insert(rows.end(), models.begin(), models.end());
    for (const RegisteredLaw& law : registered_laws()) rows.push_back(law_field(law));
    Table t =
        table_of("[material.NAME]",
                 "Isotropic elasticity; each table in it switches a model on. A model that is absent is "
                 "neither stored nor run.",
                 rows);
    t.filled_by = "preset";
    return t;
  }();
  return table;
}

}  // namespace vitrum::scene
