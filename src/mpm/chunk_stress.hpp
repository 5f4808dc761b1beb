#pragma once
#include <algorithm>
#include <vector>

#include "mpm/chunk.hpp"
#include "mpm/system.hpp"

namespace vitrum::mpm {

/// The stress of a chunk that internal forces are made of: that of a state that is tried, or the law's.
class ChunkStress {
 public:
  ChunkStress(const Chunk& chunk, const Body& body) {
    const Particles& p = body.particles;
    const auto& tried = p.tried_stress;
    if (tried[0].empty()) {
      follow(chunk, p, *body.material);
      return;
    }
    for (std::size_t c = 0; c < 4; ++c) columns_[c] = read(chunk, tried[c], values_[c]);
    columns_[4] = read(chunk, p.tried_stress_zr.empty() ? tried[3] : p.tried_stress_zr, values_[4]);
  }
  ChunkStress(const ChunkStress&) = delete;
  ChunkStress& operator=(const ChunkStress&) = delete;

  const double* rr() const { return columns_[0]; }
  const double* zz() const { return columns_[1]; }
  const double* tt() const { return columns_[2]; }
  const double* rz() const { return columns_[3]; }
  const double* zr() const { return columns_[4]; }

 private:
  void follow(const Chunk& chunk, const Particles& p, const Material& material) {
    const auto& e = p.elastic_strain;
    const ColumnReader e0(chunk, e[0]), e1(chunk, e[1]), e2(chunk, e[2]), e3(chunk, e[3]);
    VariableColumns<const double*> variables;
    variables.resize(p.variables.size());
    double copies[most_columns][Chunk::capacity];
    for (const std::size_t c : material.stress_columns())
      variables[c] = read(chunk, p.variables[c], copies[c]);
    material.stress({e0.data(), e1.data(), e2.data(), e3.data()}, variables, chunk.size(),
                    {values_[0], values_[1], values_[2], values_[3]});
    for (std::size_t c = 0; c < 5; ++c) columns_[c] = values_[std::min<std::size_t>(c, 3)];
  }
  /// The column itself where the particles lie one behind the other, else a copy.
  static const double* read(const Chunk& chunk, const std::vector<double>& column, double* copy) {
    if (chunk.contiguous()) return column.data() + chunk.place(0);
    for (std::size_t k = 0; k < chunk.size(); ++k) copy[k] = column[chunk.place(k)];
    return copy;
  }

  const double* columns_[5];
  double values_[5][Chunk::capacity];
};

}  // namespace vitrum::mpm
