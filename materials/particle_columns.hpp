#pragma once
#include <algorithm>
#include <cstddef>

#include "tensor/columns.hpp"

// How the program holds what a law stores: of one point, and of many in columns.

namespace vitrum {

/// Most numbers that a law may store of a point besides the elastic strain.
inline constexpr std::size_t most_columns = 48;

/// One material point as the program sees it: what the variables mean is the law's affair.
struct PointState {
  SymmetricTensor elastic_strain{};
  SymmetricTensor stress{};  ///< Pa; always the law's stress of `elastic_strain` and the variables
  double dissipated = 0.0;   ///< energy dissipated so far, J per m^3 of material
  /// Components of the law's own variables in the order of Material::columns(), without `dissipated`.
  std::array<double, most_columns> variables{};
};

/// Pointers to the columns of a law's variables, in the order of Material::columns(). Copies only as many as
/// there are.
template <class Pointer>
class VariableColumns {
 public:
  VariableColumns() {}  // entries beyond size() are not set
  VariableColumns(const VariableColumns& o) { *this = o; }
  VariableColumns& operator=(const VariableColumns& o) {
    size_ = o.size_;
    std::copy(o.begin(), o.end(), column_);
    return *this;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void push_back(Pointer column) { column_[size_++] = column; }
  void resize(std::size_t size) { size_ = size; }
  Pointer& operator[](std::size_t k) { return column_[k]; }
  Pointer operator[](std::size_t k) const { return column_[k]; }
  Pointer* begin() { return column_; }
  Pointer* end() { return column_ + size_; }
  const Pointer* begin() const { return column_; }
  const Pointer* end() const { return column_ + size_; }

 private:
  std::size_t size_ = 0;
  Pointer column_[most_columns];
};

/// Pointers to the columns of a range of particles (structure of arrays). The state at the start of the
/// increment is only read; that at its end may go to the same columns (the increment is committed) or to
/// others (it is tried).
struct ParticleColumns {
  TensorPointers<const double> start_strain{};     ///< elastic: rr, zz, tt, rz
  VariableColumns<const double*> start_variables;  ///< as Material::columns()
  TensorPointers<double> elastic_strain{};         ///< at the end
  TensorPointers<double> stress{};                 ///< at the end, Pa; null: not wanted
  VariableColumns<double*> variables;              ///< at the end; none: not stored
  TensorPointers<const double>
      strain_increment{};                  ///< in the frame that turns with the particle (corotational)
  const double* spin_increment = nullptr;  ///< rad, counter-clockwise from r to z
  const double* mass = nullptr;            ///< kg (per radian or per metre)
};

}  // namespace vitrum
