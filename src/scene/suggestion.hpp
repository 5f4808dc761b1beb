#pragma once
#include <span>
#include <string>
#include <string_view>

namespace vitrum::scene {

/// Number of insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`, ignoring
/// letter case.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate that `word` most likely means; empty when none is close. The first wins among equals.
std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// `text`, followed by "; did you mean '..'?" where a candidate is near `word`.
std::string with_suggestion(std::string text, std::string_view word, std::span<const std::string> candidates);

}  // namespace vitrum::scene
