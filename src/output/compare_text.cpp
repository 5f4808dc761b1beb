#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "output/compare.hpp"

namespace vitrum::output {
namespace {

using Json = nlohmann::ordered_json;

/// Quantities that a page has room for.
constexpr std::size_t listed_quantities = 12;

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

std::optional<double> change(const QuantityDifference& q) {
  return q.a && q.b ? std::optional(*q.b - *q.a) : std::nullopt;
}

Json as_json(const Comparison& c) {
  Json quantities = Json::object(), times = Json::array();
  for (const QuantityDifference& q : c.quantities)
    quantities[q.name] = {{"a", number(q.a)},
                          {"b", number(q.b)},
                          {"difference", number(change(q))},
                          {"relative", number(q.relative())},
                          {"unit", q.unit}};
  for (const TimeDifference& t : c.times) {
    Json fields = Json::object();
    for (const FieldDifference& f : t.fields)
      fields[f.name] = {{"unit", f.unit},       {"largest", number(f.largest)},   {"particle", f.particle},
                        {"rms", number(f.rms)}, {"relative", number(f.relative)}, {"only_one", f.only_one}};
    times.push_back({{"time", t.time}, {"fields", fields}});
  }
  return {{"a", c.a},
          {"b", c.b},
          {"outputs", {{"a", c.outputs_a}, {"b", c.outputs_b}}},
          {"remark", c.remark.empty() ? Json(nullptr) : Json(c.remark)},
          {"quantities", quantities},
          {"times", times}};
}

std::string shown(const std::optional<double>& value) {
  return value ? fmt::format("{:.7g}", *value) : "none";
}

/// Whether a body's line says the same as the line of all bodies: where one alone fails, it says whose it is.
bool is_of_one_body(const QuantityDifference& q, const Comparison& c) {
  constexpr std::string_view all = "failure.";
  return q.name.starts_with(all) && std::ranges::any_of(c.quantities, [&](const QuantityDifference& other) {
           return other.name.starts_with("bodies.") && other.name.ends_with(q.name.substr(all.size() - 1)) &&
                  other.a == q.a && other.b == q.b;
         });
}

std::string quantities_text(const Comparison& c) {
  if (c.quantities.empty()) return "no quantities: a summary.json is missing\n";
  std::vector<QuantityDifference> differing;
  for (const QuantityDifference& q : c.quantities)
    if (q.a != q.b && !is_of_one_body(q, c)) differing.push_back(q);
  std::string text =
      fmt::format("quantities of the summaries: {} of {} differ\n", differing.size(), c.quantities.size());
  if (differing.empty()) return text;
  std::stable_sort(
      differing.begin(), differing.end(),
      [](const QuantityDifference& x, const QuantityDifference& y) { return x.relative() > y.relative(); });
  text += fmt::format("  {:<34} {:<6} {:>14} {:>14} {:>10}\n", "quantity", "unit", "A", "B", "relative");
  const std::size_t listed = std::min(differing.size(), listed_quantities);
  for (std::size_t n = 0; n < listed; ++n) {
    const QuantityDifference& q = differing[n];
    text += fmt::format("  {:<34} {:<6} {:>14} {:>14} {:>10}\n", q.name, q.unit, shown(q.a), shown(q.b),
                        q.a && q.b ? fmt::format("{:.2e}", q.relative()) : "");
  }
  if (listed < differing.size())
    text += fmt::format("  and {} that differ less (--json lists all)\n", differing.size() - listed);
  return text;
}

/// A field over all common times.
struct FieldHistory {
  std::string name, unit;
  const FieldDifference* last = nullptr;
  const FieldDifference* worst = nullptr;
  double worst_time = 0.0;
  std::size_t only_one = 0;  ///< in the output in which they are most
};

std::vector<FieldHistory> histories(const Comparison& c) {
  std::vector<FieldHistory> fields;
  for (const TimeDifference& time : c.times)
    for (const FieldDifference& field : time.fields) {
      auto history = std::ranges::find(fields, field.name, &FieldHistory::name);
      if (history == fields.end()) history = fields.insert(fields.end(), {field.name, field.unit});
      if (history->worst == nullptr || field.rms > history->worst->rms)
        history->worst = &field, history->worst_time = time.time;
      history->last = &field;
      history->only_one = std::max(history->only_one, field.only_one);
    }
  return fields;
}

std::string fields_text(const Comparison& c) {
  if (c.times.empty()) return "";
  std::string text =
      fmt::format("fields at {} common time{}, the last t = {:.6g} s: root mean square of B - A\n",
                  c.times.size(), c.times.size() == 1 ? "" : "s", c.times.back().time);
  text += fmt::format("  {:<26} {:<6} {:>10} {:>10} {:>12} {:>10} {:>10}\n", "field", "unit", "at last",
                      "at worst", "worst at, s", "relative", "largest");
  for (const FieldHistory& field : histories(c)) {
    text += fmt::format("  {:<26} {:<6} {:>10.3e} {:>10.3e} {:>12.5e} {:>10.2e} {:>10.3e}", field.name,
                        field.unit, field.last->rms, field.worst->rms, field.worst_time,
                        field.worst->relative, field.worst->largest);
    if (field.only_one > 0) text += fmt::format("  up to {} values in one result only", field.only_one);
    text += '\n';
  }
  return text;
}

std::string page(const Comparison& c) {
  std::string text =
      fmt::format("A  {} ({} outputs)\nB  {} ({} outputs)\n", c.a, c.outputs_a, c.b, c.outputs_b);
  text += quantities_text(c) + fields_text(c);
  if (!c.remark.empty()) text += c.remark + '\n';
  return text;
}

}  // namespace

std::string comparison_text(std::span<const Comparison> comparisons, bool json) {
  std::string text;
  if (!json) {
    for (const Comparison& comparison : comparisons) text += (text.empty() ? "" : "\n") + page(comparison);
    return text;
  }
  Json all = as_json(comparisons.front());
  if (comparisons.size() > 1) all["others"] = Json::array();
  for (const Comparison& other : comparisons.subspan(1)) all["others"].push_back(as_json(other));
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace vitrum::output
