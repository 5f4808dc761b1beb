#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "tensor/symmetric.hpp"

/// Columns of many points: a vector or a tensor is one array a component (structure of arrays).
namespace vitrum {

inline constexpr std::size_t vector_components = 2;  ///< (r, z), or (x, y)
inline constexpr std::size_t tensor_components = 4;  ///< (rr, zz, tt, rz), or (xx, yy, zz, xy)

using VectorColumns = std::array<std::vector<double>, vector_components>;
using TensorColumns = std::array<std::vector<double>, tensor_components>;

/// Pointers to the columns of a tensor. Number: double, or const double.
template <class Number>
using TensorPointers = std::array<Number*, tensor_components>;

/// The tensor at place i, of columns or pointers to them, and back.
template <class Columns>
VITRUM_INLINE SymmetricTensor tensor_at(const Columns& columns, std::size_t i) {
  return {columns[0][i], columns[1][i], columns[2][i], columns[3][i]};
}
template <class Columns>
VITRUM_INLINE void put_tensor(Columns&& columns, std::size_t i, const SymmetricTensor& a) {
  columns[0][i] = a.rr, columns[1][i] = a.zz, columns[2][i] = a.tt, columns[3][i] = a.rz;
}

}  // namespace vitrum
