#include <fmt/format.h>

#include "scene/choices.hpp"
#include "scene/scene_keys.hpp"
#include "scene/sections.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {

void read_space(const TableReader& document, Scene& scene) {
  const auto space = document.table("space", keys::space());
  if (!space) return;
  space->read_choice("geometry", scene.geometry);
  space->read("cell", scene.cell);
  space->read_choice("shape_functions", scene.shape_functions);
}

void read_time(const TableReader& document, Scene& scene) {
  const auto time = document.table("time", keys::time());
  if (!time) return;
  const bool start_is_wrong = time->has("start") && !time->read("start", scene.start);
  if (time->read("end", scene.end) && !start_is_wrong && !(scene.end > scene.start))
    time->fail("end", fmt::format("a time later than 'time.start' ({})", number_text(scene.start)));
}

void require_countable(const TableReader& table, std::string_view key, const std::optional<double>& interval,
                       const Scene& scene) {
  constexpr double most = 1e12;
  const double least = (scene.end - scene.start) / most;
  if (interval && *interval < least)
    table.fail(key,
               fmt::format("at least {:.3g} s (a million-millionth of the time from start to end)", least));
}

void read_gravity(const TableReader& document, Scene& scene) {
  if (const auto gravity = document.table("gravity", keys::gravity()))
    gravity->read("acceleration", scene.gravity);
}

void read_output(const TableReader& document, Scene& scene) {
  OutputDefinition& output = scene.output;
  const auto table = document.table("output", keys::output());
  if (!table) return;
  table->read("every", output.every);
  table->read("checkpoint_every", output.checkpoint_every);
  require_countable(*table, "every", output.every, scene);
  require_countable(*table, "checkpoint_every", output.checkpoint_every, scene);
  std::vector<std::string> fields;
  if (table->read("fields", fields)) output.fields = std::move(fields);
}

}  // namespace vitrum::scene
