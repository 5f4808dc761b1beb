#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "mpm/contact/patch.hpp"
#include "mpm/particles.hpp"

namespace vitrum::mpm {

/// Which particles of a body still hang together. Particles that were neighbours at the start are joined
/// unless one of them is separated and its crack open; what no chain of joints connects any more comes off as
/// a fragment, with a velocity field of its own (Body::fragments), for good. Particles in cracks go with the
/// fragment that they are nearest to along the joints.
class Fragments {
 public:
  /// The body as it was seeded, identities in order. One whose material cannot separate has no joints.
  explicit Fragments(const Body& body);

  /// Gives what has come off since the last time fields from next_field on, by falling number of particles,
  /// and leaves the largest piece its own. Whether anything has.
  bool part(Body& body, std::int32_t& next_field);
  /// Finds the faces of a body whose fragments were restored; cut: as it was.
  void restored(const Body& body, std::span<const std::uint32_t> cut);
  /// Identities of the particles that were cut off when pieces were last looked for, rising.
  std::vector<std::uint32_t> cut() const;

  bool any() const { return !faces_.empty(); }
  /// Identities of the particles at the surfaces of the fragments, rising; none while the body is whole.
  std::span<const std::uint32_t> faces() const { return faces_; }

 private:
  void find_faces(const Body& body);

  std::vector<std::uint32_t> first_, neighbours_;  // by identity: joints
  std::vector<std::uint32_t> faces_;
  std::vector<bool> cut_;  // by identity
};

}  // namespace vitrum::mpm
