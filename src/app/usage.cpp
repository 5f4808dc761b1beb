#include "app/usage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <array>
#include <vector>

#include "scene/suggestion.hpp"

namespace vitrum::app {
namespace {

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> commands_of(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

}  // namespace

std::string usage_fault(const CLI::App& program, std::string_view cause) {
  const std::vector<CLI::App*> parsed = program.get_subcommands();
  const CLI::App& command = parsed.empty() ? program : *parsed.front();
  const std::string help =
      parsed.empty() ? "vitrum --help" : fmt::format("vitrum {} --help", command.get_name());
  const std::vector<std::string> unexpected = program.remaining(true);
  if (unexpected.empty()) return fmt::format("{} (see {})", cause, help);
  const std::string word = unexpected.front().substr(0, unexpected.front().find('='));
  const std::vector<std::string> options = options_of(command);
  std::string fact;
  if (word.starts_with('-'))
    fact = scene::with_suggestion(
        fmt::format("found an unknown option {}, expected one of {}", word, fmt::join(options, ", ")), word,
        options);
  else if (parsed.empty())
    fact = scene::with_suggestion(fmt::format("found an unknown command {}, expected one of {}", word,
                                              fmt::join(commands_of(program), ", ")),
                                  word, commands_of(program));
  else
    fact = fmt::format("found {}, expected no more arguments of {}", unexpected.front(), command.get_name());
  return fmt::format("{} (see {})", fact, help);
}

std::string examples_of(std::string_view command) {
  struct Example {
    std::string_view command, text;
  };
  constexpr std::array examples{
      Example{"new", R"(  vitrum new --list
  vitrum new impact > plate.toml
  vitrum new drop-ball --out drop.toml)"},
      Example{"run", R"(  vitrum run plate.toml
  vitrum run plate.toml --out out/fast --set body.cylinder.velocity.1=-800 --threads 1
  vitrum run plate.toml --out out/fast --set body.cylinder.velocity.1=-600 --force
  vitrum run plate.toml --out out/adaptive --set 'integrator.method="arkode-explicit"' --set integrator.rtol=1e-2
  vitrum run plate.toml --out out/elastic --set material.glass.damage=none --no-fields --quiet)"},
      Example{"check", R"(  vitrum check plate.toml
  vitrum check plate.toml --set space.cell=5e-4 --json
  vitrum check plate.toml > resolved.toml
  sed 's/200.0/400.0/' plate.toml | vitrum check -)"},
      Example{"point", R"(  vitrum point glass.toml
  vitrum point glass.toml --set path.samples=1000 --out path.csv
  vitrum point glass.toml --set 'constitutive.method="substep"' --set constitutive.rtol=1e-8 --out path.csv)"},
      Example{"info", R"(  vitrum info out/plate
  vitrum info out/plate/result.h5 --json)"},
      Example{"compare", R"(  vitrum compare out/plate out/fast
  vitrum compare out/plate out/fast out/plate --last --fields velocity,stress
  vitrum compare out/plate out/fast --fields position --tolerance 1  # exit status 1 where one differs by more
  vitrum compare out/plate out/fast --json)"},
      Example{"reference", R"(  vitrum reference > scene.md
  vitrum reference --result > result.md
  vitrum reference --materials > materials.md)"},
      Example{"", R"(  vitrum new impact > plate.toml
  vitrum check plate.toml
  vitrum run plate.toml --out out/plate
  vitrum info out/plate
vitrum COMMAND --help has more.)"},
  };
  for (const Example& example : examples)
    if (example.command == command) return fmt::format("Examples:\n{}", example.text);
  return "";
}

}  // namespace vitrum::app
