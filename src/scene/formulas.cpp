#include "scene/formulas.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/suggestion.hpp"

namespace vitrum::scene {
namespace {

struct Constant {
  const char* name;
  double value;
};
constexpr std::array<Constant, 10> constants{{{"mm", 1e-3},
                                              {"um", 1e-6},
                                              {"us", 1e-6},
                                              {"ns", 1e-9},
                                              {"ms", 1e-3},
                                              {"GPa", 1e9},
                                              {"MPa", 1e6},
                                              {"kPa", 1e3},
                                              {"g", 1e-3},
                                              {"pi", std::numbers::pi}}};
/// Time and place, which are no numbers of a file.
constexpr std::array<std::string_view, 5> variables{"t", "r", "z", "x", "y"};

bool is_word(std::string_view name) {
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
         std::ranges::all_of(
             name, [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; });
}

}  // namespace

bool is_formula(std::string_view text) {
  return text.starts_with('=');
}

std::string Formulas::define(const std::string& name, double value) {
  if (!is_word(name)) return "expected a name of letters, digits and _";
  if (std::ranges::find(constants, std::string_view(name),
                        [](const Constant& c) { return std::string_view(c.name); }) != constants.end())
    return "expected a name that is no unit or constant of formulas";
  if (std::ranges::find(variables, name) != variables.end())
    return "expected another name: t, r, z, x and y stand for time and place";
  if (mu::Parser().GetFunDef().contains(name)) return "expected a name that is no function of formulas";
  parameters_.emplace_back(name, value);
  return {};
}

std::variant<double, std::string> Formulas::value(std::string_view formula) const {
  std::vector<std::string> names;
  try {
    mu::Parser parser;
    for (const Constant& constant : constants) {
      parser.DefineConst(constant.name, constant.value);
      names.emplace_back(constant.name);
    }
    for (const auto& [name, number] : parameters_) {
      parser.DefineConst(name, number);
      names.push_back(name);
    }
    parser.SetExpr(std::string(formula.substr(1)));
    return static_cast<double>(parser.Eval());
  } catch (const mu::Parser::exception_type& error) {
    // A word that is a name, but none that is known.
    const std::string& token = error.GetToken();
    if (is_word(token) && std::ranges::find(names, token) == names.end())
      return with_suggestion(fmt::format("'{}' is no parameter, unit or function", token), token, names);
    return error.GetMsg();
  }
}

}  // namespace vitrum::scene
