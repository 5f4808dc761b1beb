#pragma once
#include "materials/law.hpp"
#include "tensor/vector.hpp"

/// For lambdas that loops over particles are made of, behind their parameters.
#define VITRUM_INLINE_LAMBDA __attribute__((always_inline))

namespace vitrum {

/// What every law keeps of a point; a law's State adds its variables, each a double, a PlaneVector or a
/// SymmetricTensor.
struct LawState {
  SymmetricTensor elastic_strain{};
  SymmetricTensor stress{};  ///< Pa
  double dissipated = 0.0;   ///< J/m^3
};

/// Fills the components of a variable with what next() gives.
template <class Next>
VITRUM_INLINE void fill(double& member, Next&& next) {
  member = next();
}
template <class Next>
VITRUM_INLINE void fill(PlaneVector& member, Next&& next) {
  member.r = next(), member.z = next();
}
template <class Next>
VITRUM_INLINE void fill(SymmetricTensor& member, Next&& next) {
  member.rr = next(), member.zz = next(), member.tt = next(), member.rz = next();
}

/// Hands them to take(value).
template <class Take>
VITRUM_INLINE void hand_over(double member, Take&& take) {
  take(member);
}
template <class Take>
VITRUM_INLINE void hand_over(const PlaneVector& member, Take&& take) {
  take(member.r), take(member.z);
}
template <class Take>
VITRUM_INLINE void hand_over(const SymmetricTensor& member, Take&& take) {
  take(member.rr), take(member.zz), take(member.tt), take(member.rz);
}

/// Turns a variable with its particle.
VITRUM_INLINE void turn(double&, const Rotation&) {}
VITRUM_INLINE void turn(PlaneVector& member, const Rotation& by) {
  member = rotate(member, by);
}
VITRUM_INLINE void turn(SymmetricTensor& member, const Rotation& by) {
  member = rotate(member, by);
}

/// A law's own state from that of a point, and back.
template <class Law>
typename Law::State load_state(const Law& law, const PointState& point) {
  typename Law::State s;
  s.elastic_strain = point.elastic_strain, s.stress = point.stress, s.dissipated = point.dissipated;
  std::size_t k = 0;
  law.members(s, [&](auto& member) VITRUM_INLINE_LAMBDA {
    fill(member, [&]() VITRUM_INLINE_LAMBDA { return point.variables[k++]; });
  });
  return s;
}
template <class Law>
void store_state(const Law& law, const typename Law::State& s, PointState& point) {
  point.elastic_strain = s.elastic_strain, point.stress = s.stress, point.dissipated = s.dissipated;
  std::size_t k = 0;
  law.members(s, [&](const auto& member) VITRUM_INLINE_LAMBDA {
    hand_over(member, [&](double v) VITRUM_INLINE_LAMBDA { point.variables[k++] = v; });
  });
}

}  // namespace vitrum
