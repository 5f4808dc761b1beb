#pragma once
#include <limits>
#include <span>
#include <vector>

#include "mpm/contact/fragments.hpp"
#include "mpm/contact/grip.hpp"
#include "mpm/contact/pair_law.hpp"
#include "mpm/contact/pairs.hpp"
#include "mpm/system.hpp"

namespace vitrum::mpm {

/// Two bodies that may touch, or the fragments of one.
struct BodyPair {
  std::size_t a, b;  ///< a <= b; the same: its fragments
  PairStiffness law;
  double friction;  ///< Coulomb's coefficient; infinite: they stick where they are pressed together
  bool may_break;   ///< cracks may open faces that no patch stands for
};

/// Where the particles of a body are that patches are placed with: columns, as those of Particles.
struct Configuration {
  std::array<const double*, 2> position;
  const double *turn, *mirrored;
};
std::vector<Configuration> configurations(const System& system);

/// What has passed between two bodies since the start.
struct ContactHistory {
  Vector impulse{};                                            ///< N s, on a (per radian or per metre)
  double friction_work = 0.0;                                  ///< J (per radian or per metre)
  double least_gap = std::numeric_limits<double>::infinity();  ///< m, of patches opposite each other
};

/// Bodies with velocity fields of their own (Body::field), which touch where patches of their surfaces do: a
/// penalty and, along the surface, a spring that Coulomb's bound lets slide. Forces act on the particles that
/// carry the patches (Particles::contact_force), so that every integrator of particles and nodes takes them
/// as it takes stress; and as a stress is, they are a function of the state kept last and the state tried.
class Contact {
 public:
  /// patches: by body. Pairs of a body with itself: what cracks cut off it comes off as a fragment.
  Contact(System& system, std::vector<BodyPair> pairs, const std::vector<std::vector<Patch>>& patches);

  /// Before an explicit step of `duration` seconds: gives particles the forces of contact at their present
  /// places, books impulses.
  void begin_step(System& system, double duration);
  /// After it, particles having moved: keeps the state they have come to.
  void end_step(System& system);

  /// For integrators that try states out. Places patches and computes their forces; whether some touch.
  bool evaluate(const System& system, std::span<const Configuration> bodies);
  /// Gives particles the forces of the state evaluated, until `unload`. rates: for every pair of bodies the
  /// force on a (2).
  void load(System& system, double* rates) const;
  static void unload(System& system);
  /// For Newton's iterations over nodes: the carriers of all patches that may touch once none has moved by
  /// more than `margin` (m) from the state evaluated.
  std::vector<CarrierPair> foresee(const System& system, double margin);
  /// Calls add(carriers, force, stretch, N/m) for all that touch: how a force along one direction changes
  /// with what the carriers are moved apart along another one. Along the normal; along the surface where it
  /// sticks; and where it slides, friction with the pressure.
  template <class Add>
  void linearise(Add&& add) const {
    for (const Touch& t : touches_) {
      const Vector along{-t.force.normal[1], t.force.normal[0]};
      const CarrierPair carriers = carriers_of(t.key.pair, t.key.carrier_a, t.key.carrier_b);
      add(carriers, t.force.normal, t.force.normal, t.force.stiffness);
      const double pull = t.friction.spring.force, friction = pairs_[t.key.pair].friction;
      if (!t.friction.slides)
        add(carriers, along, along, t.friction.spring.stiffness);
      else if (pull != 0.0)
        add(carriers, along, t.force.normal, std::copysign(friction * t.force.stiffness, pull));
    }
  }
  /// Makes the state evaluated, which is the present one, the system's, and what the rates have come to since
  /// the last time.
  void commit(System& system, std::span<const Configuration> bodies, const double* changes);
  /// Lets fragments come off the bodies (pairs of a body with itself). Whether any have: they have velocity
  /// fields of their own from now on, and the grid's lists are void. To be asked every `steps_between_looks`
  /// steps, or between Lagrangian phases.
  bool part(System& system);
  static constexpr std::int64_t steps_between_looks = 10;
  /// Lets go of all that particles carry that have left. Returns what it stored, J (per radian or per metre);
  /// what friction stored is lost with it.
  double drop_removed(System& system);
  /// Particles have been put where they are: what they stood like before is as they stand now, and no
  /// friction comes of the difference.
  void settle(const System& system);
  static constexpr std::size_t rates_of_pair = 2;

  std::span<const BodyPair> pairs() const { return pairs_; }
  std::span<const ContactHistory> history() const { return history_; }
  /// Bound of what a pair of bodies adds to the squares of frequencies while it touches, 1/s^2: k (s_a +
  /// s_b), s the surface that is carried by a particle over its mass (docs/theory/contact.md).
  double frequency_squared(std::size_t pair) const { return frequencies_squared_[pair]; }
  /// Least distance of opposite places of a pair's surfaces in the state evaluated, m; infinite: none are
  /// near.
  double gap(std::size_t pair) const { return gaps_[pair]; }

  /// What a run must know to go on: by name.
  std::vector<double> state(const System& system) const;
  /// Takes up again what `state` said, particles having been restored. False: it is not this scene's.
  bool restore(System& system, std::span<const double> state);

 private:
  struct Touch {
    TouchKey key;
    Vector arm_a, arm_b;  ///< m, from the particles to their patches
    Vector half;          ///< m, from a's patch to the middle between both, where friction acts
    PairForce force;
    Stretched friction{};
  };
  void find_deep_particles(const System& system);
  void find_frequencies(const System& system, std::size_t body, std::vector<double>& per_mass) const;
  void find_carriers(const System& system);
  void place_patches(const System& system, std::span<const Configuration> bodies);
  /// Whether the particle has left the computation.
  bool has_left(const System& system, std::size_t body, std::uint32_t identity) const {
    return place_[body][identity] >= system.bodies[body].present();
  }
  bool has_left(const System& system, const TouchKey& key) const {
    return has_left(system, pairs_[key.pair].a, key.carrier_a) ||
           has_left(system, pairs_[key.pair].b, key.carrier_b);
  }
  void find_touches(const System& system, std::span<const Configuration> bodies);
  void find_touches_of_particles(const System& system, std::span<const Configuration> bodies,
                                 std::size_t pair);
  void find_touches_of_fragments(const System& system, std::span<const Configuration> bodies,
                                 std::size_t pair);
  void touch_as_circles(const System& system, std::span<const Configuration> bodies, std::size_t pair,
                        std::uint32_t i, std::uint32_t j, double distance);
  Vector place_of(std::span<const Configuration> bodies, std::size_t body, std::uint32_t identity) const {
    const std::size_t i = place_[body][identity];
    return {bodies[body].position[0][i], bodies[body].position[1][i]};
  }
  void foresee_fragments(const System& system, std::size_t pair, double margin,
                         std::vector<CarrierPair>& list);
  void list_faces(std::span<const Configuration> bodies, std::size_t body);
  double distance_of(std::size_t body, std::uint32_t i, std::uint32_t j, double usual) const;
  void touch(std::span<const Configuration> bodies, Touch&& touch);
  Grip grip_of(const TouchKey& key, const Spring& spring, std::span<const Configuration> bodies) const;
  double way(const Touch& touch, const Grip& before, const Grip& now) const;
  void keep(System& system, std::span<const Configuration> bodies);
  void push(System& system, const Touch& touch) const;
  static Vector friction_on_b(const Touch& t) {
    return {-t.force.normal[1] * t.friction.spring.force, t.force.normal[0] * t.friction.spring.force};
  }
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
  std::vector<ContactHistory> history_;            // by pair
  std::vector<double> frequencies_squared_;        // by pair
  std::vector<Patch> patches_;                     // of all bodies
  std::vector<std::size_t> first_;                 // of each body's patches, and their number
  std::vector<std::vector<std::uint32_t>> place_;  // by body and identity: in the columns
  std::vector<std::vector<bool>> deep_;            // by body and identity: no patch was near it at the start
  std::size_t sorted_ = 0;                         // Grid::times_sorted when carriers were found
  bool found_ = false;                             // carriers are
  bool evaluated_ = false;                         // touches are those of the particles' present places
  std::vector<PlacedPatch> placed_;
  std::vector<Vector> places_;                        // of patches
  std::vector<std::vector<Vector>> particle_places_;  // by body and identity, where cracks may open
  /// Particles of two fragments that were nearer to each other than circles when these came apart: they touch
  /// from that distance on.
  struct Rest {
    std::uint32_t body, i, j;  // identities, i < j
    double distance;           // m
    auto operator<=>(const Rest&) const = default;
  };
  std::vector<Fragments> fragments_;      // by body; empty where none has a pair with itself
  std::vector<Rest> rests_;               // rising
  std::int32_t next_field_;               // for the next fragment
  std::vector<Touch> touches_;            // by rising key
  std::vector<Grip> grips_, next_grips_;  // of the state kept last, by rising key
  std::vector<double> gaps_;              // m, least, by pair
  PairSearch search_;
};

}  // namespace vitrum::mpm
