// Prints the dictionary of the fuzz targets from the key tables: key names, headers, choices, and numbers at
// the edges of what a double, an integer and a scene can hold.
#include <fmt/format.h>

#include <array>
#include <set>
#include <string>
#include <string_view>

#include "scene/scene_keys.hpp"

namespace {

using namespace vitrum::scene;

constexpr std::array syntax{
    "[",          "]",       "[[",          "]]",     "{", "}", "=",          ",",
    ".",          "\n",      "\"",          "\"\"\"", "#", "_", "[[body]]\n", "[[boundary]]\n",
    "[material.", "body.0.", "boundary.0.", "\\u0000"};
constexpr std::array numbers{"0",
                             "-0.0",
                             "1",
                             "-1",
                             "0.5",
                             "-0.5",
                             "0.25",
                             "0.3926",
                             "0.49999999999999994",
                             "1.0000000000000002",
                             "inf",
                             "-inf",
                             "nan",
                             "1e-300",
                             "5e-324",
                             "1e-20",
                             "1e-9",
                             "1e-3",
                             "1e3",
                             "1e9",
                             "1e20",
                             "1.7976931348623157e308",
                             "-1.7976931348623157e308",
                             "2147483648",
                             "4294967296",
                             "9007199254740993",
                             "9223372036854775807",
                             "-9223372036854775808",
                             "0x7fffffffffffffff",
                             "true",
                             "1979-05-27T07:32:00Z"};

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\n')
      result += "\\x0A";
    else if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else
      result += c;
  }
  return result;
}

void collect(KeyTable table, std::set<std::string>& words) {
  for (const KeyInfo& key : table) {
    words.insert(key.name);
    for (const std::string& choice : key.choices) words.insert('"' + choice + '"');
    if (key.expected.starts_with("a table [")) words.insert(fmt::format("[{}]\n", key.name));
    if (!key.fallback.empty()) words.insert(fmt::format("{} = {}\n", key.name, key.fallback));
  }
}

}  // namespace

int main() {
  namespace keys = vitrum::scene::keys;
  std::set<std::string> words(syntax.begin(), syntax.end());
  words.insert(numbers.begin(), numbers.end());
  for (const KeyTable& table : {keys::scene(),
                                keys::point(),
                                keys::state(),
                                keys::space(),
                                keys::time(),
                                keys::integrator(),
                                keys::constitutive(),
                                keys::output(),
                                keys::gravity(),
                                keys::path(),
                                keys::body(),
                                keys::box(),
                                keys::disk(),
                                keys::ring(),
                                keys::boundary(vitrum::Geometry::axisymmetric),
                                keys::boundary(vitrum::Geometry::plane_strain),
                                keys::boundary_box(),
                                keys::material(),
                                keys::damage(),
                                keys::fixed_rate(),
                                keys::drucker_prager(),
                                keys::von_mises(),
                                keys::decohesion()})
    collect(table, words);
  for (const vitrum::RegisteredLaw& law : vitrum::registered_laws()) collect(keys::law(law), words);
  fmt::print("# Printed by fuzz_dictionary from the key tables; do not edit.\n");
  for (const std::string& word : words) fmt::print("\"{}\"\n", escaped(word));
}
