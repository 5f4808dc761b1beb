#pragma once
#include <limits>
#include <span>
#include <vector>

#include "mpm/contact/pair_law.hpp"
#include "mpm/contact/pairs.hpp"
#include "mpm/system.hpp"

namespace vitrum::mpm {

/// Two bodies that may touch.
struct BodyPair {
  std::size_t a, b;  ///< a < b
  PairStiffness law;
  double friction;  ///< Coulomb's coefficient; infinite: they stick
  bool may_break;   ///< cracks may open faces that no patch stands for
};

/// Where the particles of a body are that patches are placed with: columns, as those of Particles.
struct Configuration {
  std::array<const double*, 2> position;
  const double *turn, *mirrored;
};
std::vector<Configuration> configurations(const System& system);

/// Velocities of a body's particles as the grid moves them, by place, and their spin.
struct ParticleMotion {
  std::array<const double*, 2> velocity;  ///< m/s
  const double* spin;                     ///< rad/s
};

/// What has passed between two bodies since the start.
struct ContactHistory {
  Vector impulse{};                                            ///< N s, on a (per radian or per metre)
  double friction_work = 0.0;                                  ///< J (per radian or per metre)
  double least_gap = std::numeric_limits<double>::infinity();  ///< m, of patches opposite each other
};

/// Bodies with velocity fields of their own (Body::field), which touch where patches of their surfaces do: a
/// penalty, whose energy is stored, and Coulomb's friction. Forces act on the particles that carry the
/// patches (Particles::contact_force), so that every integrator of particles and nodes takes them as it takes
/// stress.
class Contact {
 public:
  /// patches: by body. slip_speed: m/s, at which friction has its full size.
  Contact(System& system, std::vector<BodyPair> pairs, const std::vector<std::vector<Patch>>& patches,
          double slip_speed);

  /// Before an explicit step of `duration` seconds: gives particles the forces of contact at their present
  /// places, books friction and impulses.
  void begin_step(System& system, double duration);
  /// After it, particles having moved: the energy stored now goes to the record, and how patches have moved
  /// is what friction acts against next.
  void end_step(System& system, double duration);

  /// For integrators that try states out. Places patches and computes their forces; whether some touch.
  bool evaluate(const System& system, std::span<const Configuration> bodies);
  /// Gives particles the forces of the state evaluated, until `unload`. motion: by body. rates: for every
  /// pair of bodies the force on a (2) and the power of friction, a Lipschitz function of the state.
  void load(System& system, std::span<const ParticleMotion> motion, double* rates) const;
  static void unload(System& system);
  /// Whether there is friction at all: else nobody asks for motions.
  bool rubs() const;
  /// For Newton's iterations over nodes: the carriers of all patches that may touch once none has moved by
  /// more than `margin` (m) from the state evaluated.
  std::vector<CarrierPair> foresee(double margin);
  /// Calls add(carriers, normal, N/m, along, N s/m) for all that touch: stiffness along the normal, damping
  /// by friction along the surface.
  template <class Add>
  void linearise(std::span<const ParticleMotion> motion, Add&& add) const {
    for (const Touch& t : touches_) {
      const Vector along{-t.force.normal[1], t.force.normal[0]};
      add(carriers_of(t.pair, t.carrier_a, t.carrier_b), t.force.normal, t.force.stiffness, along,
          damping(t, motion));
    }
  }
  /// Makes what the rates have come to since the last time the system's; the state evaluated is the present.
  void commit(System& system, const double* changes);
  static constexpr std::size_t rates_of_pair = 3;

  std::span<const BodyPair> pairs() const { return pairs_; }
  std::span<const ContactHistory> history() const { return history_; }

  /// What a run must know to go on: by name.
  std::vector<double> state() const;
  /// Takes up again what `state` said, particles having been restored. False: it is not this scene's.
  bool restore(std::span<const double> state);

 private:
  static constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);
  struct Touch {
    std::size_t pair;                    ///< of bodies
    std::uint32_t carrier_a, carrier_b;  ///< identities of the particles
    std::uint32_t patch_a, patch_b;      ///< counted over all bodies; none: the particles themselves touch
    Vector arm_a, arm_b;                 ///< m, from the particles to their patches
    Vector half;  ///< m, from a's patch to the middle between both, where friction acts
    PairForce force;
  };
  void find_deep_particles(const System& system);
  void find_carriers(const System& system);
  void place_patches(const System& system, std::span<const Configuration> bodies);
  void find_touches(const System& system, std::span<const Configuration> bodies);
  void find_touches_of_particles(const System& system, std::span<const Configuration> bodies,
                                 std::size_t pair);
  void note_state(System& system);
  template <class Size>
  Vector rub(const Touch& touch, const Vector& sliding, const Size& size_of, double& power) const;
  void push(System& system, const Touch& touch, const Vector& friction) const;
  Vector sliding(const Touch& touch, std::span<const ParticleMotion> motion) const;
  double damping(const Touch& touch, std::span<const ParticleMotion> motion) const;
  CarrierPair carriers_of(std::size_t pair, std::uint32_t a, std::uint32_t b) const {
    return {pairs_[pair].a, place_[pairs_[pair].a][a], pairs_[pair].b, place_[pairs_[pair].b][b]};
  }
  std::span<const PlacedPatch> patches_of(std::size_t body) const {
    return std::span(placed_).subspan(first_[body], first_[body + 1] - first_[body]);
  }
  std::span<const Vector> places_of(std::size_t body) const {
    return std::span(places_).subspan(first_[body], first_[body + 1] - first_[body]);
  }
  double reach(const BodyPair& pair) const;

  std::vector<BodyPair> pairs_;
  std::vector<ContactHistory> history_;  // by pair
  double slip_speed_;
  std::vector<Patch> patches_;                     // of all bodies
  std::vector<std::size_t> first_;                 // of each body's patches, and their number
  std::vector<std::vector<std::uint32_t>> place_;  // by body and identity: in the columns
  std::vector<std::vector<bool>> deep_;            // by body and identity: no patch was near it at the start
  std::size_t sorted_ = 0;                         // Grid::times_sorted when carriers were found
  bool found_ = false;                             // carriers are
  bool evaluated_ = false;                         // touches are those of the particles' present places
  std::vector<PlacedPatch> placed_, before_;
  std::vector<Vector> places_;                        // of patches
  std::vector<std::vector<Vector>> particle_places_;  // by body and identity, where cracks may open
  std::vector<double> mirrored_, mirrored_before_;
  std::vector<Vector> velocity_;  // m/s, by patch, in the last step
  std::vector<Touch> touches_;
  std::vector<double> gaps_;  // m, least, by pair
  PairSearch search_;
};

}  // namespace vitrum::mpm
