#include "materials/scatter.hpp"

#include <cmath>

#include "schema/field.hpp"

namespace vitrum {
using schema::required;

const schema::Table& StrengthScatter::table() {
  using S = StrengthScatter;
  static const schema::Table table = schema::in_one_line(schema::table_of<S>(
      "`scatter` of a law's strength",
      "Flaws: the strength of each particle, of volume V, is the law's times (volume / V)^(1/modulus) times "
      "a "
      "random number of Weibull's distribution (scale 1, shape `modulus`), so that the strength of a body "
      "does not depend on the cells. V is that of the whole ring in axisymmetric geometry, of 1 m of depth "
      "in plane strain.",
      {{"modulus", &S::modulus, {1.0, 1000.0}, "Weibull modulus", required},
       {"volume", &S::volume, "m^3", intervals::positive,
        "of which 63 % fail below the law's strength, under uniform stress", required},
       {"seed", &S::seed, {0.0, 1.0e9}, "another seed, other flaws"}}));
  return table;
}

std::vector<Variable> scatter_variables() {
  return {{.name = StrengthScatter::column,
           .unit = "1",
           .text = "strength of the point over that of the law (`scatter`)",
           .initial = 1.0,
           .bounds = intervals::positive}};
}

namespace {

/// A number of all bits from a counter: the output function of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t counter) {
  std::uint64_t z = counter * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

}  // namespace

double draw_strength_factor(const StrengthScatter& scatter, double volume, std::uint64_t body,
                            std::uint64_t identity) {
  const std::uint64_t bits =
      mixed(mixed(mixed(static_cast<std::uint64_t>(scatter.seed) + 1) + body) + identity);
  constexpr double unit = 1.0 / 9007199254740992.0;  // 2^-53
  const double probability = (static_cast<double>(bits >> 11U) + 0.5) * unit;
  return std::pow(-std::log1p(-probability) * scatter.volume / volume, 1.0 / scatter.modulus);
}

}  // namespace vitrum
