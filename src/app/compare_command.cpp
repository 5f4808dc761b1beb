#include "app/compare_command.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/command_line.hpp"
#include "app/messages.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::app {

int compare(const CompareOptions& options) {
  std::vector<output::Comparison> comparisons;
  for (std::size_t other = 1; other < options.results.size(); ++other)
    comparisons.push_back(
        output::compare_results(options.results.front(), options.results[other], options.what));
  show(output::comparison_text(comparisons, options.json));
  if (!options.tolerance) return exit_done;
  bool apart = false;
  for (const output::Comparison& comparison : comparisons) {
    if (!output::differ(comparison, *options.tolerance)) continue;
    tell("{}: differs from {} by more than {:g}\n", scene::single_line(comparison.b),
         scene::single_line(comparison.a), *options.tolerance);
    apart = true;
  }
  return apart ? exit_differ : exit_done;
}

}  // namespace vitrum::app
