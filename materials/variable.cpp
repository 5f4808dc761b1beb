#include "materials/variable.hpp"

#include <string_view>

namespace vitrum {
namespace {

struct Part {
  std::string_view suffix, text;
  bool odd_in_r;  // has r an odd number of times
};
constexpr Part of_scalar[] = {{"", "", false}};
constexpr Part of_vector[] = {{"_r", "r (x) component of ", true}, {"_z", "z (y) component of ", false}};
constexpr Part of_symmetric[] = {{"_rr", "rr (xx) component of ", false},
                                 {"_zz", "zz (yy) component of ", false},
                                 {"_tt", "tt (zz) component of ", false},
                                 {"_rz", "rz (xy) component of ", true}};

std::span<const Part> parts_of(Kind kind) {
  switch (kind) {
    case Kind::scalar:
      return of_scalar;
    case Kind::vector:
      return of_vector;
    case Kind::symmetric:
      return of_symmetric;
  }
  return of_scalar;
}

}  // namespace

std::vector<Component> components_of(std::span<const Variable> variables) {
  std::vector<Component> list;
  for (const Variable& v : variables)
    for (const Part& part : parts_of(v.kind))
      list.push_back({v.name + std::string(part.suffix), v.unit, std::string(part.text) + v.text, v.scale,
                      v.initial, v.bounds, part.odd_in_r != (v.parity == Parity::odd)});
  return list;
}

}  // namespace vitrum
