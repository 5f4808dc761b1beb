#pragma once
#include "materials/composite.hpp"

namespace vitrum {

/// Hooke's law as a matrix.
inline TangentEntries elastic_entries(const Moduli& m) {
  const double lame = m.bulk - 2.0 / 3.0 * m.shear, p = lame + 2.0 * m.shear;
  return {p, lame, lame, 0.0, lame, p, lame, 0.0, lame, lame, p, 0.0, 0.0, 0.0, 0.0, 2.0 * m.shear};
}

template <bool D, Yielding Y, bool C>
TangentEntries Composite<D, Y, C>::tangent(const PointState& start, const SymmetricTensor& strain,
                                           double duration) const {
  if (elastic_only || stays_elastic(start, strain, duration)) {
    PointState end = start;
    end.elastic_strain += strain;
    return elastic_entries(secant_moduli(end));
  }
  const auto end_after = [&](const SymmetricTensor& increment) {
    PointState s = start;
    PointReport report;
    respond(s, increment, duration, report);
    return s;
  };
  // Central differences: the average of both sides at a kink.
  const auto differences = [&](double step, double& largest) {
    TangentEntries T{};
    largest = 0.0;
    for (std::size_t column = 0; column < 4; ++column) {
      SymmetricTensor shift{};
      (column == 0 ? shift.rr : column == 1 ? shift.zz : column == 2 ? shift.tt : shift.rz) = step;
      const SymmetricTensor change =
          (0.5 / step) * (end_after(strain + shift).stress - end_after(strain - shift).stress);
      T[column] = change.rr, T[4 + column] = change.zz, T[8 + column] = change.tt, T[12 + column] = change.rz;
      const double size = norm(change);
      largest = size <= largest ? largest : size;  // keeps what is not a number
    }
    return T;
  };
  // The step is far above what rounding leaves of the stress, far below the strains over which the laws
  // change.
  const double step = 1e-6 * std::max({norm(start.elastic_strain), norm(strain), 1e-9});
  double largest = 0.0, nearer = 0.0;
  const TangentEntries T = differences(step, largest);
  if (largest <= 2.0 * elastic_.p_wave()) return T;
  // So steep is growing damage, which keeps its slope in a quarter of the stencil, or a jump, which does not.
  differences(0.25 * step, nearer);
  if (std::abs(nearer - largest) <= 0.1 * largest) return T;
  return elastic_entries(secant_moduli(end_after(strain)));
}

template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::tangent(const ParticleColumns& p, std::size_t begin, std::size_t end,
                                 double duration, TangentEntries* tangents) const {
  PointState s;
  for (std::size_t i = begin; i < end; ++i) {
    load(p, i, s);
    s.stress = secant_moduli(s).stress(s.elastic_strain);
    const SymmetricTensor strain{p.strain_increment[0][i], p.strain_increment[1][i], p.strain_increment[2][i],
                                 p.strain_increment[3][i]};
    tangents[i] = tangent(s, strain, duration);
  }
}

}  // namespace vitrum
