#include "schema/json_schema.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace vitrum::schema {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity: an open end is no bound, and taplo makes null of inf.
Json number_schema(const Key& key) {
  const Bounds& b = key.bounds;
  Json json{{"type", {"number", "string"}}, {"pattern", "^="}};  // a formula is a text
  if (key.over_time) {
    json["type"].push_back("object");
    json["properties"] = {
        {"table", {{"type", "array"}, {"description", "rows [t, value]; linear between them"}}},
        {"csv", {{"type", "string"}, {"description", "a file of rows t,value beside this one"}}}};
  }
  if (b.contain(intervals::infinite) || b.contain(-intervals::infinite)) json["type"].push_back("null");
  if (std::isfinite(b.lowest)) json[b.lowest_open ? "exclusiveMinimum" : "minimum"] = b.lowest;
  if (std::isfinite(b.highest)) json[b.highest_open ? "exclusiveMaximum" : "maximum"] = b.highest;
  return json;
}

Json integer_schema(const Key& key) {
  if (!key.admitted.empty())
    return {{"anyOf", {Json{{"enum", key.admitted}}, Json{{"type", "string"}, {"pattern", "^="}}}}};
  Json json = number_schema(key);
  json["type"][0] = "integer";
  return json;
}

Json text_schema(const Key& key) {
  std::vector<std::string> choices = key.choices;
  choices.insert(choices.end(), key.choices_elsewhere.begin(), key.choices_elsewhere.end());
  return choices.empty() ? Json{{"type", "string"}} : Json{{"enum", choices}};
}

/// Of `length` items or, 0, of any number from `least` on.
Json list_schema(Json items, std::size_t length, std::size_t least = 0) {
  Json json{{"type", "array"}, {"items", std::move(items)}};
  if (std::max(length, least) > 0) json["minItems"] = std::max(length, least);
  if (length > 0) json["maxItems"] = length;
  return json;
}

/// `whole`: required keys are required. (They are not where a preset may give them.)
Json table_schema(const Table& table, bool whole);

Json value_schema(const Key& key, bool whole) {
  const auto [kind, length, width] = key.shape;
  switch (kind) {
    case Kind::number:
      return number_schema(key);
    case Kind::integer:
      return integer_schema(key);
    case Kind::flag:
      return {{"type", "boolean"}};
    case Kind::text:
      return text_schema(key);
    case Kind::numbers:
      return list_schema(number_schema(key), length, 1);
    case Kind::rows:
      if (length == 0 && width == 2)
        return {
            {"anyOf",
             {list_schema(list_schema(number_schema(key), width), length, key.fewest),
              {{"type", "object"},
               {"properties",
                {{"csv",
                  {{"type", "string"}, {"description", "a file of rows of two numbers beside this one"}}}}},
               {"required", Json::array({"csv"})}}}}};
      return list_schema(list_schema(number_schema(key), width), length, key.fewest);
    case Kind::texts: {
      Json json = list_schema(text_schema(key), length);
      json["uniqueItems"] = true;
      return json;
    }
    case Kind::named_numbers:
      return {{"type", "object"}, {"additionalProperties", number_schema(key)}};
    case Kind::table:
      return table_schema(*key.table, whole);
    case Kind::tables:
      if (key.table->in_one_line)
        return {
            {"anyOf", {list_schema(table_schema(*key.table, whole), 0, 1), table_schema(*key.table, whole)}}};
      return list_schema(table_schema(*key.table, whole), 0, key.required ? 1 : 0);
    case Kind::named_tables: {
      Json json{{"type", "object"}, {"additionalProperties", table_schema(*key.table, whole)}};
      if (key.required) json["minProperties"] = 1;
      return json;
    }
  }
  return Json::object();
}

Json value_json(const Value& value) {
  if (const auto* named = std::get_if<NamedNumbers>(&value)) {
    Json json = Json::object();
    for (const auto& [name, number] : *named) json[name] = number;
    return json;
  }
  return std::visit([](const auto& v) { return Json(v); }, value);
}

Json key_schema(const Key& key, bool whole) {
  Json json = value_schema(key, whole);
  if (key.table != nullptr && key.get) json = {{"anyOf", {std::move(json), table_schema(*key.table, whole)}}};
  json["description"] = key.text + "\n\n" + expected(key);
  if (key.fallback) json["default"] = value_json(*key.fallback);
  return json;
}

/// Where one key is needed, each by itself; else no two together.
Json alternatives_schema(const Alternatives& group) {
  Json rules = Json::array();
  for (std::size_t i = 0; i < group.keys.size(); ++i)
    if (!group.needed.empty())
      rules.push_back({{"required", Json::array({group.keys[i]})}});
    else
      for (std::size_t j = 0; j < i; ++j) rules.push_back({{"required", {group.keys[j], group.keys[i]}}});
  if (!group.needed.empty()) return {{"oneOf", std::move(rules)}};
  return {{"not", {{"anyOf", std::move(rules)}}}};
}

Json table_schema(const Table& table, bool whole) {
  Json json{{"type", "object"}, {"additionalProperties", false}};
  Json properties = Json::object(), required = Json::array();
  for (const Key& key : table.keys) {
    properties[key.name] = key_schema(key, whole && table.filled_by.empty());
    if (key.required) required.push_back(key.name);
  }
  json["properties"] = std::move(properties);
  if (!table.filled_by.empty())
    json["anyOf"] = {{{"required", Json::array({table.filled_by})}}, {{"required", std::move(required)}}};
  else if (whole && !required.empty())
    json["required"] = std::move(required);
  for (const Alternatives& group : table.alternatives) json["allOf"].push_back(alternatives_schema(group));
  return json;
}

}  // namespace

std::string json_schema(const Table& table, const std::string& title) {
  Json json{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  json.update(table_schema(table, true));
  return json.dump(2) + '\n';
}

}  // namespace vitrum::schema
