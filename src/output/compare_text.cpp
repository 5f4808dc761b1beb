#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "output/compare.hpp"

namespace vitrum::output {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

std::optional<double> change(const QuantityDifference& q) {
  return q.a && q.b ? std::optional(*q.b - *q.a) : std::nullopt;
}

Json as_json(const Comparison& c) {
  Json quantities = Json::object(), times = Json::array();
  for (const QuantityDifference& q : c.quantities)
    quantities[q.name] = {{"a", number(q.a)}, {"b", number(q.b)}, {"difference", number(change(q))}};
  for (const TimeDifference& t : c.times) {
    Json fields = Json::object();
    for (const FieldDifference& f : t.fields)
      fields[f.name] = {{"unit", f.unit},
                        {"largest", number(f.largest)},
                        {"particle", f.particle},
                        {"relative", number(f.relative)},
                        {"only_one", f.only_one}};
    times.push_back({{"time", t.time}, {"fields", fields}});
  }
  return {{"outputs", {{"a", c.outputs_a}, {"b", c.outputs_b}}},
          {"remark", c.remark.empty() ? Json(nullptr) : Json(c.remark)},
          {"quantities", quantities},
          {"times", times}};
}

std::string shown(const std::optional<double>& value) {
  return value ? fmt::format("{:.7g}", *value) : "none";
}

}  // namespace

std::string comparison_text(const Comparison& c, bool json) {
  if (json) return as_json(c).dump(2) + "\n";
  std::string text;
  if (!c.quantities.empty())
    text += fmt::format("{:<44} {:>14} {:>14} {:>14} {:>10}\n", "quantity", "A", "B", "B - A", "relative");
  for (const QuantityDifference& q : c.quantities) {
    const std::optional<double> d = change(q);
    const std::string relative = d && *q.a != 0.0 ? fmt::format("{:.2e}", *d / std::abs(*q.a)) : "";
    text += fmt::format("{:<44} {:>14} {:>14} {:>14} {:>10}\n", q.name, shown(q.a), shown(q.b), shown(d),
                        relative);
  }
  text += fmt::format("outputs: {} in A, {} in B, {} at common times\n", c.outputs_a, c.outputs_b,
                      c.times.size());
  if (!c.remark.empty()) text += c.remark + "\n";
  for (const TimeDifference& t : c.times) {
    text += fmt::format("t = {:.6e} s\n", t.time);
    for (const FieldDifference& f : t.fields) {
      text += fmt::format("  {:<20} largest {:.3e} {} (particle {}), relative {:.2e}", f.name, f.largest,
                          f.unit, f.particle, f.relative);
      if (f.only_one > 0) text += fmt::format(", {} values in one result only", f.only_one);
      text += '\n';
    }
  }
  return text;
}

}  // namespace vitrum::output
