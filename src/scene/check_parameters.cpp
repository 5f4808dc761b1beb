#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scene/checks.hpp"
#include "scene/suggestion.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

using Names = std::set<std::string, std::less<>>;

/// That a parameter is none that formulas name, and which are.
std::string expected_parameter(std::string_view name, const Names& named,
                               const schema::NamedNumbers& parameters) {
  std::vector<std::string> known;
  for (const auto& [parameter, unused] : parameters)
    if (named.contains(parameter)) known.push_back(parameter);
  const std::string what = "found a parameter that no formula names, expected ";
  return known.empty()
             ? what + fmt::format("a formula with it: \"={}\"", name)
             : with_suggestion(what + (known.size() > 1 ? "one of " : "") + schema::quoted_list(known), name,
                               known);
}

/// "NAME = VALUE": what the formulas with a parameter were evaluated with.
std::optional<std::string> evaluated_with(std::string_view name,
                                          const std::optional<std::vector<std::string>>& evaluated) {
  for (const std::string& each : evaluated.value_or(std::vector<std::string>{}))
    if (each.substr(0, each.find(" = ")) == name) return each;
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<std::string>> check_parameters(
    const TableView& document, const schema::NamedNumbers& parameters,
    const std::optional<std::vector<std::string>>& evaluated) {
  const Formulas& formulas = document.formulas();
  Names numbers, functions;
  for (const auto& [unused, text] : formulas.used())
    if (is_formula(text)) numbers.merge(names_in(text));
  for (const auto& [unused, function] : formulas.functions()) functions.merge(names_in(function.formula));
  Names named = numbers;
  named.insert(functions.begin(), functions.end());

  Diagnostics& diagnostics = document.diagnostics();
  const bool all_read = diagnostics.empty();
  std::vector<std::string> list;
  for (const auto& [name, value] : parameters) {
    const std::optional<std::string> was = evaluated_with(name, evaluated);
    const std::string now = fmt::format("{} = {}", name, number_text(value)), then = was.value_or(now),
                      path = join_path("parameters", name);
    if (was || numbers.contains(name)) list.push_back(then);
    if (now != then)
      diagnostics.add(path, document.toml()["parameters"][name].node()->source().begin, path,
                      fmt::format("found {} in a resolved scene, where formulas with it are numbers by now, "
                                  "of {}; expected it to be set in the scene that was resolved",
                                  now, then));
    else if (all_read && diagnostics.overridden(path) && !was && !named.contains(name))
      diagnostics.add(path, {}, path, expected_parameter(name, named, parameters));
  }
  return list.empty() ? std::nullopt : std::optional(list);
}

}  // namespace vitrum::scene
