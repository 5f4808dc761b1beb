#include "scene/formulas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <vector>

#include "scene/formula_parser.hpp"
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
                                              {"g", 9.80665},
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

std::set<std::string, std::less<>> names_in(std::string_view formula) {
  const auto is_part = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
  std::set<std::string, std::less<>> names;
  for (auto c = formula.begin(); c != formula.end();) {
    const auto begin = std::find_if(c, formula.end(), is_part);
    c = std::find_if_not(begin, formula.end(), is_part);
    names.emplace(begin, c);  // and numbers, which are no names
  }
  return names;
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

void prepare(mu::Parser& parser, const Formulas& formulas, double* t, std::array<double, 2>* place) {
  parser.ClearConst();  // its own _pi has 12 digits
  for (const Constant& constant : constants) parser.DefineConst(constant.name, constant.value);
  for (const auto& [name, number] : formulas.parameters()) parser.DefineConst(name, number);
  if (t != nullptr) parser.DefineVar("t", t);
  for (std::size_t c = 0; place != nullptr && c < 2; ++c)
    parser.DefineVar(std::string(formulas.place_names()[c]), &(*place)[c]);
}

namespace {

/// What muParser found, in words of scenes.
std::string fault_text(const mu::Parser::exception_type& error, const Formulas& formulas, bool over_time,
                       bool over_place) {
  const std::string& token = error.GetToken();
  std::vector<std::string> names;
  for (const Constant& constant : constants) names.emplace_back(constant.name);
  for (const auto& [name, unused] : formulas.parameters()) names.push_back(name);
  if (over_time) names.emplace_back("t");
  if (over_place) names.insert(names.end(), formulas.place_names().begin(), formulas.place_names().end());
  if (!is_word(token) || std::ranges::find(names, token) != names.end()) return error.GetMsg();
  if (std::ranges::find(variables, token) != variables.end())
    return fmt::format("'{}' means nothing at this key", token);
  if (std::ranges::find(formulas.announced(), token) != formulas.announced().end())
    return fmt::format("parameter '{}' has no value here: it takes one that stands above and is sound",
                       token);
  return with_suggestion(fmt::format("'{}' is no parameter, unit or function", token), token, names);
}

/// The value of what has been set. Of several formulas, which a comma separates, muParser gives the last: a
/// decimal comma would go unnoticed.
double only_value(mu::Parser& parser) {
  int count = 0;
  const double* values = parser.Eval(count);
  if (count == 1) return values[0];
  throw mu::Parser::exception_type(
      fmt::format("found {} formulas with commas between, expected one (decimals have a point)", count));
}

/// A decimal of few digits where the value is one but for rounding: 20*us is 2e-5.
double without_rounding(double value) {
  const double few = std::strtod(fmt::format("{:.12g}", value).c_str(), nullptr);
  return std::abs(few - value) <= 4.0 * std::numeric_limits<double>::epsilon() * std::abs(value) ? few
                                                                                                 : value;
}

}  // namespace

std::variant<double, std::string> Formulas::value(std::string_view formula) const {
  try {
    mu::Parser parser;
    prepare(parser, *this, nullptr, nullptr);
    parser.SetExpr(std::string(formula.substr(1)));
    return without_rounding(only_value(parser));
  } catch (const mu::Parser::exception_type& error) {
    return fault_text(error, *this, false, false);
  }
}

std::string Formulas::fault(std::string_view formula, bool over_time, bool over_place, bool& varies) const {
  FormulaVariables at;
  try {
    mu::Parser parser;
    prepare(parser, *this, over_time ? &at.t : nullptr, over_place ? &at.place : nullptr);
    parser.SetExpr(std::string(formula.substr(1)));
    only_value(parser);
    varies = !parser.GetUsedVar().empty();  // after the value, which an unknown name does not have
    return {};
  } catch (const mu::Parser::exception_type& error) {
    return fault_text(error, *this, over_time, over_place);
  }
}

}  // namespace vitrum::scene
