#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "materials/law.hpp"

namespace vitrum {

/// The particles of one body, structure of arrays; every non-empty array has `size` entries.
struct Particles {
  std::size_t size = 0;
  VectorColumns position;        ///< m, (r, z) or (x, y)
  VectorColumns velocity;        ///< m/s
  std::vector<double> mass;      ///< kg per radian (axisymmetric) or per metre (plane strain); constant
  TensorColumns elastic_strain;  ///< (rr, zz, tt, rz)
  std::vector<std::vector<double>> variables;  ///< in the order of Material::columns()
  std::vector<std::size_t> flipping;           ///< those whose sign a mirror across the axis changes
  std::vector<std::uint32_t> identity;  ///< number of the particle at the start; outputs are in this order
  // Where bodies have contact (mpm/contact) or tractions, else empty: what pieces of the surface follow.
  std::vector<double> turn;      ///< rad since the start, counter-clockwise from r to z
  std::vector<double> mirrored;  ///< 1, or -1 where the particle has become its own image at the axis

  // With shape functions over domains that follow the particles (mpm/domain.hpp), else empty.
  std::array<std::vector<double>, 3> stretch;  ///< logarithmic strain since the start, (rr, zz, rz)
  std::array<std::vector<double>, 2> domain;   ///< m, half of its extent along r and z

  // Scratch, empty where passes take particles over their increments at once (mpm/transfer.hpp): strain
  // increment in the frame that turns with the particle, and turn.
  TensorColumns strain_increment;
  std::vector<double> spin_increment;  ///< rad, counter-clockwise from r to z
  /// Stress follows from elastic strain and variables (Material::stress). Not empty: an integrator tries a
  /// state (mpm/trial.hpp), whose stress is this instead, Pa, (rr, zz, tt, rz).
  TensorColumns tried_stress;
  /// Not empty: forces act on a configuration of the past, and the stress tried is the nominal one, whose
  /// shears differ; tried_stress[3] is then P_rz and this P_zr, Pa.
  std::vector<double> tried_stress_zr;
  /// Force of contact and tractions, N (per radian or per metre), and couple, N m; empty: none acts.
  std::array<std::vector<double>, 3> contact_force;

  /// Gradient of the centroids of what nodes collect (mpm/centroids.hpp), (rr, rz, zr, zz), for the particles
  /// where they are; empty: gradients are taken between nodes.
  std::array<std::vector<double>, 4> centroids;
  /// The way from where the interpolated centroids are to the particle, m; empty as they are.
  std::array<std::vector<double>, 2> from_centroids;

  /// Has room for the variables of a material from now on, at 0.
  void keep_variables(std::span<const Component> columns) {
    variables.assign(columns.size(), std::vector<double>(size, 0.0));
    flipping.clear();
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k].flips) flipping.push_back(k);
  }
  /// Has room for increments from now on.
  void keep_increments() {
    for (auto& column : strain_increment) column.resize(size);
    spin_increment.resize(size);
  }
};

/// What is known of a body that coasts (mpm/coasting.hpp).
struct Coasting {
  std::array<double, 2> velocity;         ///< m/s, of all its particles
  std::array<double, 2> lowest, highest;  ///< m, of its particles' positions
  double kinetic;                         ///< J (per radian or per metre)
};

struct Body {
  std::string name;
  std::shared_ptr<const Material> material;
  Particles particles;
  double particle_half_size = 0.0;  ///< m, half the side of a particle's initial square (GIMP)
  std::int32_t field = 0;  ///< velocity field: bodies with the same one are welded where they share nodes
  std::optional<Coasting> coasting = std::nullopt;
  /// Velocity fields of its particles, by identity, once it has come into pieces; empty: all have `field`.
  std::vector<std::int32_t> fragments = {};

  /// Particles that have left the computation (mpm/removal.hpp): they stand behind all others in storage.
  std::size_t removed = 0;

  /// The column of a variable by its name; empty where the material has none.
  const std::vector<double>& column(std::string_view variable) const {
    static const std::vector<double> none;
    const std::optional<std::size_t> k = material->column(variable);
    return k ? particles.variables[*k] : none;
  }
  std::int32_t field_of(std::size_t particle) const {
    return fragments.empty() ? field : fragments[particles.identity[particle]];
  }
  /// Half of what shape functions average over at a particle, m.
  double half(std::size_t axis, std::size_t particle) const {
    const std::vector<double>& own = particles.domain[axis];
    return own.empty() ? particle_half_size : own[particle];
  }
  /// Particles that have not left the computation, and those that take part in the grid: the first in
  /// storage.
  std::size_t present() const { return particles.size - removed; }
  std::size_t on_grid() const { return coasting ? 0 : present(); }
};

}  // namespace vitrum
