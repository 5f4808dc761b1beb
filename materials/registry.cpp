#include "materials/registry.hpp"

#include <algorithm>
#include <stdexcept>

#include "materials/composite/make.hpp"
#include "materials/johnson_cook.hpp"
#include "materials/johnson_holmquist.hpp"
#include "materials/maxwell.hpp"
#include "materials/register.hpp"

namespace vitrum {

std::span<const RegisteredLaw> registered_laws() {
  // One line a law: law<Law>("table", "what it is").
  static const std::vector<RegisteredLaw> laws{
      law<JohnsonHolmquist>("johnson_holmquist", "JH-2: glass and ceramics under high pressure"),
      law<JohnsonCook>("johnson_cook", "metals at high rates, heated by their plastic work"),
      law<Maxwell>("maxwell", "viscoelasticity of interlayers, a Prony series"),
  };
  return laws;
}

const RegisteredLaw* find_law(std::string_view table) {
  const auto laws = registered_laws();
  const auto found = std::ranges::find(laws, table, &RegisteredLaw::table);
  return found == laws.end() ? nullptr : &*found;
}

std::shared_ptr<const Material> make_material(const MaterialParameters& p, double cell) {
  if (!p.law) return make_composite(p, cell);
  const RegisteredLaw* law = find_law(p.law->table);
  if (law == nullptr)
    throw std::invalid_argument("material '" + p.name + "': no law is called '" + p.law->table + "'");
  if (p.damage || p.drucker_prager || p.von_mises || p.decohesion)
    throw std::invalid_argument("material '" + p.name + "': '" + p.law->table + "' excludes other models");
  return law->make(p, cell);
}

std::span<const Component> all_columns() {
  static const std::vector<Component> columns = [] {
    std::vector<Component> list;
    const auto add = [&list](std::span<const Variable> variables) {
      for (Component& column : components_of(variables))
        if (std::ranges::find(list, column.name, &Component::name) == list.end())
          list.push_back(std::move(column));
    };
    add(damage_variables()), add(plasticity_variables()), add(decohesion_variables());
    add(averaged_rate_variables()), add(scatter_variables());
    for (const RegisteredLaw& law : registered_laws()) add(law.variables);
    const Variable dissipated = dissipated_variable();
    add(std::span(&dissipated, 1));
    return list;
  }();
  return columns;
}

}  // namespace vitrum
