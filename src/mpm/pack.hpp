#pragma once

namespace vitrum::mpm {

/// Two or four doubles that are computed with as one: the compiler maps them onto what the processor has.
template <int width>
struct PackOf;
template <>
struct PackOf<2> {
  using type = double __attribute__((vector_size(16), may_alias));
};
template <>
struct PackOf<4> {
  using type = double __attribute__((vector_size(32), may_alias));
};
template <int width>
using Pack = typename PackOf<width>::type;

}  // namespace vitrum::mpm
