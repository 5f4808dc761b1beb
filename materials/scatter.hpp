#pragma once
#include <cstdint>
#include <vector>

#include "materials/variable.hpp"

namespace vitrum {

namespace schema {
struct Table;
}

/// Scene table `scatter` of a law's strength: flaws, by Weibull's weakest link. What a volume V bears exceeds
/// s times the law's strength with probability exp(-(V / volume) s^modulus).
struct StrengthScatter {
  double modulus = 0.0;
  double volume = 0.0;  ///< m^3, that the law's strength is the characteristic one of (63 % fail below it)
  int seed = 1;

  /// The column of strengths over the law's.
  static constexpr const char* column = "strength_factor";
  static const schema::Table& table();
};

/// What a law that scatters stores of each point, as its last variable.
std::vector<Variable> scatter_variables();

/// The strength factor of one particle of a volume (m^3), by who it is: the same whoever draws it, and in
/// whatever order.
double draw_strength_factor(const StrengthScatter& scatter, double volume, std::uint64_t body,
                            std::uint64_t identity);

}  // namespace vitrum
