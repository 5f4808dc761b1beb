#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "materials/law.hpp"
#include "schema/table.hpp"

namespace vitrum {

/// A key of a law's table whose value the others, or the elasticity, exclude.
struct Contradiction {
  std::string_view key;
  std::string expected;
};

/// A law that a scene names by the table [material.NAME.TABLE] instead of the composite's models.
struct RegisteredLaw {
  std::string table;
  std::string text;                 ///< what it is, a sentence for the scene reference
  schema::Table keys;               ///< of the struct that `values` gives
  std::vector<Variable> variables;  ///< all that it may store
  /// Parameters at their defaults, and the struct among them that `keys` read.
  LawParameters (*defaults)(std::string_view table);
  const void* (*values)(const LawParameters& parameters);
  /// Of parameters.law, each of whose values is within its bounds.
  std::function<std::optional<Contradiction>(const MaterialParameters& parameters)> contradiction;
  /// Of parameters.law. cell: side of the grid cells, m.
  std::function<std::shared_ptr<const Material>(const MaterialParameters& parameters, double cell)> make;
};

/// All laws but the composite, which is what a material is made of without one of these.
std::span<const RegisteredLaw> registered_laws();
/// The law of a table; null: there is none.
const RegisteredLaw* find_law(std::string_view table);

/// Every column that some material may store, by the first law that has it: the composite's models, then the
/// registered laws, then `dissipated`.
std::span<const Component> all_columns();

}  // namespace vitrum
