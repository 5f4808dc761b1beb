#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "observe/observer.hpp"
#include "output/provenance.hpp"

namespace vitrum::output {

/// A quantity of every particle at one output.
struct Field {
  std::string name;  ///< dataset of the result file; no '/'
  std::string unit;  ///< "1" for pure numbers
  std::string description;
  std::size_t components = 1;
  std::vector<double> values;  ///< particles x components, row-major
};

/// Everything one output adds to the result file.
struct OutputFrame {
  double time = 0.0;            ///< s
  std::int64_t step_index = 0;  ///< time steps taken so far
  std::vector<Field> fields;    ///< all with the same particles; empty: no particle data
  std::vector<Quantity> series;
  std::vector<double>
      fragment;  ///< number of each particle's fragment, for drawing; empty: nothing can separate
};

/// What is constant per particle; the order is that of every Field.
struct ParticleConstants {
  std::vector<std::string> bodies;  ///< names
  std::vector<std::uint32_t> body;  ///< index into `bodies`
  std::vector<double> mass;         ///< in `mass_unit`
  std::vector<double> size;         ///< m, side of the particle's square at the start
  std::string mass_unit;            ///< "kg" (axisymmetric: of the whole ring) or "kg/m"
};

/// Everything a result file says once.
struct RunHeader {
  std::string title;
  std::string scene_verbatim;  ///< the scene file's text
  std::string scene_resolved;  ///< TOML with every default filled in
  Provenance provenance;
  ParticleConstants particles;
};

}  // namespace vitrum::output
