// Prints the dictionary of the fuzz targets from the tables of keys: names, headers, choices, and numbers at
// the edges of what a double, an integer and a scene can hold.
#include <fmt/format.h>

#include <array>
#include <set>
#include <string>
#include <string_view>

#include "scene/scene_tables.hpp"
#include "scene/write_table.hpp"

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

void collect(const vitrum::schema::Table& table, std::set<std::string>& words) {
  for (const vitrum::schema::Key& key : table.keys) {
    words.insert(key.name);
    for (const auto* choices : {&key.choices, &key.choices_elsewhere})
      for (const std::string& choice : *choices) words.insert('"' + choice + '"');
    if (key.table != nullptr && key.table->heading == '[' + key.name + ']')
      words.insert(fmt::format("[{}]\n", key.name));
    if (key.fallback) words.insert(fmt::format("{} = {}\n", key.name, value_text(*key.fallback)));
  }
}

}  // namespace

int main() {
  std::set<std::string> words(syntax.begin(), syntax.end());
  words.insert(numbers.begin(), numbers.end());
  for (const vitrum::schema::Table* file : {&scene_table(vitrum::Geometry::axisymmetric), &point_table()})
    visit_tables(*file, [&](const vitrum::schema::Table& table) { collect(table, words); });
  fmt::print("# Printed by fuzz_dictionary from the tables of keys; do not edit.\n");
  for (const std::string& word : words) fmt::print("\"{}\"\n", escaped(word));
}
