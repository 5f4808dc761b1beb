#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "scene/input_error.hpp"
#include "scene/read_table.hpp"
#include "scene/write_table.hpp"
#include "schema/field.hpp"
#include "schema/json_schema.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using schema::Field;
using schema::Fields;
using schema::required;
using schema::table_of;

namespace {

enum class Colour { red, green };
constexpr std::array colours{schema::Named{"red", Colour::red}, schema::Named{"green", Colour::green}};

struct Inner {
  std::string name;
  double size = 2.0;
  friend bool operator==(const Inner&, const Inner&) = default;
};
using Pair = std::array<double, 2>;

/// A member of each kind that a row knows.
struct Outer {
  double number = 0.0;
  std::optional<double> maybe;
  int integer = 3, square = 4;
  bool flag = true;
  std::string text = "default";
  Colour colour = Colour::green;
  Pair pair{1.0, 2.0};
  std::vector<double> list;
  std::array<Pair, 2> matrix{};
  std::vector<SymmetricTensor> rows;
  std::array<std::string, 2> names{"a", "b"};
  std::optional<double> one, other;
  std::variant<Inner, Pair> either;
  std::optional<Inner> inner;
  std::vector<Inner> inners;
  std::vector<Inner> named;
  friend bool operator==(const Outer&, const Outer&) = default;
};

const schema::Table& inner_table() {
  static const schema::Table table =
      table_of<Inner>("[inner]", "", {{"size", &Inner::size, "m", intervals::positive, "how large"}});
  return table;
}

const schema::Table& outer_table() {
  using O = Outer;
  static const schema::Table table = [] {
    schema::Table t =
        table_of<O>("The file", "",
                    {{"number", &O::number, "m", {-1.0, 1.0}, "a number", required},
                     {"maybe", &O::maybe, "1", intervals::infinite_too, "a number or none"},
                     {"integer", &O::integer, Bounds{0.0, 9.0}, "a digit"},
                     {"square", &O::square, schema::OneOf{{1, 4, 9}}, "a square"},
                     {"flag", &O::flag, "yes or no"},
                     {"text", &O::text, "any text"},
                     {"colour", &O::colour, colours, "a choice"},
                     {"pair", &O::pair, "m/s", intervals::finite, "two numbers"},
                     {"list", &O::list, "s", intervals::finite, "numbers"},
                     {"matrix", &O::matrix, "1/s", intervals::finite, "two rows"},
                     {"rows", &O::rows, "1", intervals::finite, "tensors"},
                     {"names", &O::names, "two texts"},
                     {"one", &O::one, "1", intervals::finite, "not with the other"},
                     Field<O>("other", &O::other, "1", intervals::finite, "not with the one").otherwise(0.5),
                     Field<O>::alternative<Pair>("point", &O::either, "m", intervals::finite, "one of two"),
                     Field<O>::alternative<Inner>("thing", &O::either, inner_table(), "the other of two"),
                     {"inner", &O::inner, inner_table(), "a table or none"},
                     {"item", &O::inners, inner_table(), "tables"},
                     Field<O>::named("part", &O::named, inner_table(), "tables with names")});
    t.alternatives = {{{"one", "other"}, ""}, {{"point", "thing"}, "place"}};
    return t;
  }();
  return table;
}

Outer read(std::string_view text) {
  const toml::table document = toml::parse(text);
  scene::Diagnostics diagnostics("f");
  scene::Formulas formulas({"r", "z"});
  Outer outer;
  scene::read_table({document, "", outer_table(), diagnostics, formulas}, &outer);
  diagnostics.throw_if_any();
  return outer;
}

std::vector<std::string> faults(std::string_view text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.messages();
  }
  return {};
}

}  // namespace

TEST_CASE("a struct that is written reads back as the same, whatever it holds", "[schema]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-300.0, 300.0);
  const auto any = [&] { return (random() % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, exponent(random)); };
  const auto chance = [&] { return random() % 2 == 0; };
  const auto inner = [&](std::string name) { return Inner{std::move(name), std::abs(any())}; };
  for (int trial = 0; trial < 200; ++trial) {
    Outer o;
    o.number = std::sin(any());
    if (chance()) o.maybe = chance() ? -INFINITY : any();
    o.integer = static_cast<int>(random() % 10);
    o.square = chance() ? 1 : 9;
    o.flag = chance();
    o.text = chance() ? "a \"b\" \\ \n\u00e9" : "";
    o.colour = chance() ? Colour::red : Colour::green;
    o.pair = {any(), any()};
    o.list = {any(), any(), any()};
    o.matrix = {Pair{any(), any()}, Pair{any(), any()}};
    o.rows.assign(1 + random() % 3, SymmetricTensor{any(), any(), any(), any()});
    o.names = {"x", "y.z"};
    (chance() ? o.one : o.other) = any();
    if (chance())
      o.either = Pair{any(), any()};
    else
      o.either = Inner{"", std::abs(any())};
    if (chance()) o.inner = inner("");
    for (unsigned k = 0; k < random() % 3; ++k) o.inners.push_back(inner(""));
    for (unsigned k = 0; k < random() % 3; ++k) o.named.push_back(inner("name " + std::to_string(k)));
    const std::string text = scene::table_text(outer_table(), &o);
    INFO(text);
    CHECK(read(text) == o);
  }
}

TEST_CASE("what a file does not say is as the struct has it", "[schema]") {
  Outer expected;
  expected.number = 0.25;
  expected.other = 0.5;  // in effect where neither of the two is given
  expected.either = Pair{0.0, 1.0};
  CHECK(read("number = 0.25\npoint = [0, 1]") == expected);
  expected.other.reset();
  expected.one = 7.0;
  CHECK(read("number = 0.25\npoint = [0, 1]\none = 7") == expected);
}

TEST_CASE("each kind of value says what it expects, and where", "[schema]") {
  const auto fault = [](const std::string& line) {
    const std::vector<std::string> found = faults("number = 0\npoint = [0, 0]\n" + line);
    REQUIRE(found.size() == 1);
    return found[0];
  };
  CHECK(fault("maybe = nan") == "f:3:9: key 'maybe': found nan, expected a number, inf admitted");
  CHECK(fault("integer = 10") == "f:3:11: key 'integer': found 10, expected an integer from 0 to 9");
  CHECK(fault("integer = 1.0") == "f:3:11: key 'integer': found 1.0, expected an integer from 0 to 9");
  CHECK(fault("square = 2") == "f:3:10: key 'square': found 2, expected 1, 4 or 9");
  CHECK(fault("flag = 1") == "f:3:8: key 'flag': found 1, expected true or false");
  CHECK(fault("text = 1") == "f:3:8: key 'text': found 1, expected a string");
  CHECK(fault("colour = \"gren\"") ==
        "f:3:10: key 'colour': found \"gren\", expected one of \"red\", \"green\"; did you mean 'green'?");
  CHECK(fault("pair = [1]") ==
        "f:3:8: key 'pair': found a list of 1, expected a list of 2 finite numbers (m/s)");
  CHECK(fault("pair = [1, inf]") == "f:3:12: key 'pair.1': found inf, expected a finite number (m/s)");
  CHECK(fault("list = []") ==
        "f:3:8: key 'list': found an empty list, expected a list of one or more finite numbers (s)");
  CHECK(fault("matrix = [[1, 2]]") ==
        "f:3:10: key 'matrix': found a list of 1, expected 2 rows of 2 finite numbers (1/s)");
  CHECK(fault("rows = [[1, 2]]") == "f:3:9: key 'rows.0': found a list of 2, expected a list of 4 numbers");
  CHECK(fault("names = [\"a\", \"a\"]") == "f:3:15: key 'names.1': found \"a\", expected every entry once");
  CHECK(fault("inner = 1") == "f:3:9: key 'inner': found 1, expected a table [inner]");
  CHECK(fault("item = [1]") == "f:3:9: key 'item.0': found 1, expected a table");
  CHECK(fault("[part.x]\nsize = -1") == "f:4:8: key 'part.x.size': found -1, expected a number > 0 (m)");
  CHECK(fault("other = 1\none = 2") ==
        "f:4:7: key 'one': found together with 'other', expected only one of the two");
  CHECK(fault("thing = {}") == "f:1:1: found \"point\", \"thing\", expected exactly one of point, thing");
  CHECK(fault("numbr = 1").find("did you mean 'number'?") != std::string::npos);
  CHECK(faults("point = [0, 0]") ==
        std::vector<std::string>{"f:1:1: key 'number': found nothing, expected a number in [-1, 1] (m)"});
}

TEST_CASE("a row's bounds, choices, default and meaning stand in the JSON schema", "[schema]") {
  const auto json = nlohmann::json::parse(schema::json_schema(outer_table(), "a test"));
  const auto& keys = json["properties"];
  CHECK(json["required"] == nlohmann::json{"number"});
  CHECK(json["additionalProperties"] == false);
  CHECK(keys["number"]["minimum"] == -1.0);
  CHECK(keys["number"]["description"].get<std::string>().starts_with("a number"));
  CHECK(keys["maybe"]["type"] == nlohmann::json{"number", "string", "null"});
  CHECK(keys["integer"]["default"] == 3);
  CHECK(keys["square"]["anyOf"][0]["enum"] == nlohmann::json{1, 4, 9});
  CHECK(keys["colour"]["enum"] == nlohmann::json{"red", "green"});
  CHECK(keys["matrix"]["maxItems"] == 2);
  CHECK(keys["rows"]["items"]["minItems"] == 4);
  CHECK(keys["part"]["additionalProperties"]["properties"]["size"]["exclusiveMinimum"] == 0.0);
  CHECK(json["allOf"].size() == 2);
}
