#include "scene/suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace vitrum::scene {
namespace {

int lower(char c) {
  return std::tolower(static_cast<unsigned char>(c));
}

/// A word keeps at least half of its letters, else the suggestion would be a guess.
bool is_close(std::size_t distance, std::size_t longer) {
  return distance <= 1 + longer / 4 && 2 * distance <= longer;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the optimal string alignment table: the last one and the one before it are enough for
  // swaps.
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + (same ? 0U : 1U)});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

std::string nearest(std::string_view word, std::span<const std::string> candidates) {
  std::string best;
  // A pasted value of any length must not cost more than a glance.
  if (word.size() > 64) return best;
  std::size_t least = word.size() + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least && is_close(distance, std::max(word.size(), candidate.size()))) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string with_suggestion(std::string text, std::string_view word,
                            std::span<const std::string> candidates) {
  const std::string guess = nearest(word, candidates);
  return guess.empty() ? text : fmt::format("{}; did you mean '{}'?", text, guess);
}

}  // namespace vitrum::scene
