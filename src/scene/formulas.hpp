#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "schema/value.hpp"

namespace vitrum::scene {

/// Whether a text in place of a number is a formula: "=R + 5*mm".
bool is_formula(std::string_view text);

/// The names in a formula: of parameters, units, functions and variables.
std::set<std::string, std::less<>> names_in(std::string_view formula);

/// The names of the coordinates in formulas.
using PlaceNames = std::array<std::string_view, 2>;

/// Evaluates the formulas of a file: numbers, functions and operators of muParser, units, and the parameters
/// of the file.
class Formulas {
 public:
  /// folder: where the names of files begin.
  explicit Formulas(const PlaceNames& place, schema::NamedNumbers parameters = {},
                    std::filesystem::path folder = {})
      : place_(place), parameters_(std::move(parameters)), folder_(std::move(folder)) {}

  /// Makes a parameter known to what is evaluated from now on. Returns what is wrong with its name; empty:
  /// nothing.
  std::string define(const std::string& name, double value);

  /// The parameters that the file gives; a formula that names one which is not known yet is told so.
  void announce(std::vector<std::string> names) { announced_ = std::move(names); }

  /// The value of a formula, or what is wrong with it.
  std::variant<double, std::string> value(std::string_view formula) const;
  /// What is wrong with a formula that may vary over time or place; empty: nothing. varies: whether it does.
  std::string fault(std::string_view formula, bool over_time, bool over_place, bool& varies) const;

  const PlaceNames& place_names() const { return place_; }
  const std::filesystem::path& folder() const { return folder_; }
  const schema::NamedNumbers& parameters() const { return parameters_; }
  const std::vector<std::string>& announced() const { return announced_; }

  /// Formulas and names of files in place of numbers, for the resolved scene.
  void note(const std::string& path, std::string_view formula) { used_.emplace_back(path, formula); }
  const schema::PlacedTexts& used() const { return used_; }
  /// Functions by the path of their key.
  void note(const std::string& path, schema::Function function) { functions_[path] = std::move(function); }
  const schema::Functions& functions() const { return functions_; }

 private:
  PlaceNames place_;
  schema::NamedNumbers parameters_;
  std::vector<std::string> announced_;
  std::filesystem::path folder_;
  schema::PlacedTexts used_;
  schema::Functions functions_;
};

}  // namespace vitrum::scene
