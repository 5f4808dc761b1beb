#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace vitrum {

/// Damage D from which a particle counts as damaged (`first_damage`), and from which it belongs to the damage
/// front. Crack density grows with the first tension, however small: without a threshold rounding would be
/// the first damage.
inline constexpr double damage_threshold = 0.001, damage_front_threshold = 0.1;

/// Where and when something happened first.
struct FirstEvent {
  double time, r, z;  ///< s, m, m (x and y in plane strain)
  std::string body;
};

/// A connected piece of unseparated material.
struct Fragment {
  std::string body;
  std::size_t particles;
  double mass;         ///< kg (whole body in axisymmetric scenes, per metre in plane strain)
  double centre[2];    ///< m
  double velocity[2];  ///< m/s
};

/// What happened first, how much and how far, in one body or in all.
struct FailureMeasures {
  std::optional<FirstEvent> first_damage;  ///< damage D passes 0.001
  std::optional<FirstEvent> first_localisation;
  std::optional<FirstEvent> first_separation;
  std::size_t localised = 0, separated = 0;  ///< particles, at the end
  double crack_area = 0.0;        ///< m^2 (plane strain: per metre, m), sum of V0/L_e of the localised
  double localised_volume = 0.0;  ///< m^3 (m^2), sum of their V0
  std::optional<double> localised_radius_max;  ///< m, largest r (|x| in plane strain) of a localised particle
  std::optional<double> damage_front_radius;   ///< m, largest r with D > 0.1
  std::optional<double> max_opening;           ///< m, largest norm of the opening
  std::optional<double> max_opening_radius;    ///< m, where
};

/// The `failure` block of the summary: the measures over all bodies, and what only the whole has.
struct FailureReport : FailureMeasures {
  std::vector<FailureMeasures> bodies;  ///< each body's own, in order
  std::optional<bool> perforated;       ///< none: no body moves towards one that can separate
  std::vector<Fragment> fragments;      ///< by falling mass
};

}  // namespace vitrum
