#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace vitrum {

/// Where and when something happened first.
struct FirstEvent {
  double time, r, z;  ///< s, m, m (x and y in plane strain)
  std::string body;
};

/// A connected piece of unseparated material.
struct Fragment {
  std::string body;                      ///< of most of its mass
  std::size_t particles;
  double mass;                           ///< kg (whole body in axisymmetric scenes, per metre in plane strain)
  double centre[2];                      ///< m
  double velocity[2];                    ///< m/s
};

/// The `failure` block of the summary.
struct FailureReport {
  std::optional<FirstEvent> first_damage;        ///< damage D passes 0.001
  std::optional<FirstEvent> first_localisation;
  std::optional<FirstEvent> first_separation;
  std::size_t localised = 0, separated = 0;      ///< particles, at the end
  std::optional<double> localised_radius_max;    ///< m, largest r (|x| in plane strain) of a localised particle
  std::optional<double> damage_front_radius;     ///< m, largest r with D > 0.1
  std::optional<double> max_opening;             ///< m, largest norm of the opening
  std::optional<double> max_opening_radius;      ///< m, where
  std::optional<bool> perforated;                ///< none: the scene has no projectile and target
  std::vector<Fragment> fragments;               ///< by falling mass
};

}  // namespace vitrum
