#pragma once
#include "output/output_frame.hpp"

namespace vitrum::output {

/// A run header with three particles of two bodies.
inline RunHeader sample_header() {
  RunHeader header;
  header.title = "Glas und Stahl, ∅ 1 cm";
  header.scene_verbatim = "title = \"x\"\n# größer\n";
  header.scene_resolved = "title = \"x\"\n";
  header.provenance = {"0.1", "abc",  "vitrum run 'a b.toml'", "6.4.1",
                       "GNU", "here", "2026-01-31T12:00:00Z",  "00ff"};
  header.particles = {{"plate", "cylinder"}, {0, 0, 1}, {1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}, "kg"};
  return header;
}

/// Output number `index`; every number in it tells which output it belongs to.
inline OutputFrame sample_frame(std::size_t index, std::size_t particles = 3) {
  const double base = static_cast<double>(index) * 1000.0;
  OutputFrame frame{1.0e-6 * static_cast<double>(index), static_cast<std::int64_t>(10 * index), {}, {}, {}};
  Field position{"position", "m", "position (r, z)", 2, {}}, damage{"damage", "1", "damage", 1, {}};
  for (std::size_t p = 0; p < particles; ++p) {
    position.values.push_back(base + static_cast<double>(p));
    position.values.push_back(-base - static_cast<double>(p));
    damage.values.push_back(base + 0.5);
  }
  frame.fields = {position, damage};
  frame.series = {{"kinetic", "J", "kinetic energy", base + 0.25}};
  return frame;
}

}  // namespace vitrum::output
