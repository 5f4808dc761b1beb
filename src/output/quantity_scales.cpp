#include "output/quantity_scales.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace vitrum::output {
namespace {

using Json = QuantityScales::Json;

/// A number of an object; 0 where there is none.
double number(const Json& object, const std::string& key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_number() ? found->get<double>() : 0.0;
}
const Json& part(const Json& object, const std::string& key) {
  static const Json none;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() ? *found : none;
}

bool is_share(std::string_view name) {
  return name.ends_with("relative_residual") || name.ends_with("max_growth");
}
bool is_momentum(const std::string& name) {
  return name.find(".momentum.") != std::string::npos || name.find(".impulse.") != std::string::npos;
}
/// Next to zero at the origin or the axis.
bool is_place(const std::string& name) {
  return name.find(".centre.") != std::string::npos || name.ends_with("least_gap") || name.ends_with(".r") ||
         name.ends_with(".z") || name.ends_with("max_opening_radius");
}
bool is_length(const std::string& name) {
  return is_place(name) || name.ends_with("radius") || name.ends_with("radius_max") ||
         name.ends_with("opening");
}
bool is_energy(const std::string& name) {
  return (name.starts_with("energy.") && !is_share(name)) || name.ends_with(".kinetic") ||
         name.ends_with(".friction_work");
}

double largest_energy(const Json& account) {
  double largest = 0.0;
  for (const auto& [key, value] : account.items())
    if (!is_share(key)) largest = std::max(largest, std::abs(number(account, key)));
  return largest;
}

}  // namespace

QuantityScales::QuantityScales(const std::array<Json, 2>& summaries, double duration, std::string energy_unit)
    : duration_(duration), energy_unit_(std::move(energy_unit)) {
  for (const Json& summary : summaries) energy_ = std::max(energy_, largest_energy(part(summary, "energy")));
  for (const Json& summary : summaries) {
    const Json& bodies = part(summary, "bodies");
    const auto momentum = [&](double mass) { return std::sqrt(2.0 * mass * energy_); };
    double mass = 0.0;
    for (const auto& [name, body] : bodies.items()) {
      mass += number(body, "mass");
      momenta_["bodies." + name + "."] = momentum(number(body, "mass"));
      for (const Json& component : part(body, "centre"))
        if (component.is_number()) length_ = std::max(length_, std::abs(component.get<double>()));
    }
    if (mass > 0.0) length_ = std::max(length_, duration_ * std::sqrt(2.0 * energy_ / mass));
    std::size_t pair = 0;
    for (const Json& contact : part(summary, "contacts")) {
      double lighter = mass;
      for (const Json& name : part(contact, "bodies"))
        if (name.is_string()) lighter = std::min(lighter, number(part(bodies, name), "mass"));
      momenta_["contacts." + std::to_string(pair++) + "."] = momentum(lighter);
    }
  }
}

std::string QuantityScales::unit(const std::string& name) const {
  const bool per_metre = energy_unit_.ends_with("/m");
  if (name.ends_with("time")) return "s";
  if (is_momentum(name)) return per_metre ? "kg/s" : "kg m/s";
  if (is_length(name)) return "m";
  if (name.ends_with("mass")) return per_metre ? "kg/m" : "kg";
  if (name.ends_with("crack_area")) return per_metre ? "m" : "m^2";
  if (name.ends_with("localised_volume")) return per_metre ? "m^2" : "m^3";
  return is_energy(name) ? energy_unit_ : "1";
}

double QuantityScales::scale(const std::string& name) const {
  if (is_share(name)) return 1.0;
  if (name.ends_with("time")) return duration_;
  if (is_momentum(name)) return momentum_scale(name);
  if (is_place(name)) return length_;
  return is_energy(name) ? energy_ : 0.0;
}

double QuantityScales::momentum_scale(const std::string& name) const {
  for (const auto& [beginning, scale] : momenta_)
    if (name.starts_with(beginning)) return scale;
  return 0.0;
}

}  // namespace vitrum::output
