#pragma once
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "schema/value.hpp"

namespace vitrum::scene {

/// Whether a text in place of a number is a formula: "=R + 5*mm".
bool is_formula(std::string_view text);

/// Evaluates the formulas of a file: numbers, functions and operators of muParser, units, and the parameters
/// of the file.
class Formulas {
 public:
  /// Makes a parameter known to what is evaluated from now on. Returns what is wrong with its name; empty:
  /// nothing.
  std::string define(const std::string& name, double value);

  /// The value of a formula, or what is wrong with it.
  std::variant<double, std::string> value(std::string_view formula) const;

  /// Formulas by the path of their key, for the resolved scene.
  void note(const std::string& path, std::string_view formula) { used_[path] = formula; }
  const std::map<std::string, std::string>& used() const { return used_; }

 private:
  schema::NamedNumbers parameters_;
  std::map<std::string, std::string> used_;
};

}  // namespace vitrum::scene
