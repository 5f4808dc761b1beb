#include "app/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "app/check_command.hpp"
#include "app/compare_command.hpp"
#include "app/messages.hpp"
#include "app/new_command.hpp"
#include "app/point_command.hpp"
#include "app/run_command.hpp"
#include "app/usage.hpp"
#include "mpm/computation_error.hpp"
#include "output/info.hpp"
#include "output/provenance.hpp"
#include "output/reference_page.hpp"
#include "scene/input_error.hpp"
#include "scene/presets.hpp"
#include "scene/reference_page.hpp"

namespace vitrum::app {
namespace {

constexpr const char* out_of_memory =
    "error: out of memory; of a run, reduce the number of particles (space.cell, particles_per_cell)\n";

/// Where memory runs out in a function that must not throw (destructors of JSON values allocate, and toml++
/// does while it unwinds: then there is no exception to be asked), no handler is reached.
[[noreturn]] void end_without_handler() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    std::fputs("error: cannot go on, most likely because memory has run out\n", stderr);
    std::_Exit(exit_computation);
  } catch (const std::bad_alloc&) {
    std::fputs(out_of_memory, stderr);
    std::_Exit(exit_computation);
  } catch (...) {
  }
  std::abort();
}

int failed(const std::exception& error, int status) {
  complain(error.what());
  return status;
}

template <class Command>
int guarded(Command&& command) {
  try {
    return command();
  } catch (const InputError& error) {
    for (const std::string& message : error.messages()) complain(message);
    return exit_input;
  } catch (const ComputationError& error) {
    return failed(error, exit_computation);
  } catch (const FileError& error) {
    return failed(error, exit_file);
  } catch (const std::bad_alloc&) {
    std::fputs(out_of_memory, stderr);  // formatting might want memory
    return exit_computation;
  } catch (const std::exception& error) {
    return failed(error, exit_computation);
  }
}

std::string whole_command(int argc, char** argv) {
  std::string text;
  for (int i = 0; i < argc; ++i) text += (i ? " " : "") + shell_quoted(argv[i]);
  return text;
}

int obey(int argc, char** argv) {
  CLI::App program{"vitrum: fragmentation of glass under impact by the material point method"};
  program.require_subcommand(0, 1);
  bool version = false;
  program.add_flag("--version", version, "versions of vitrum and of the libraries it is built with");

  RunOptions run;
  run.program = argv[0];
  run.command = whole_command(argc, argv);
  const auto add_scene = [](CLI::App& command, std::string& scene, std::vector<std::string>& overrides) {
    command.add_option("SCENE", scene, "scene file (TOML); check: - is standard input")->required();
    command
        .add_option("--set", overrides,
                    "override a key: a.b.c=VALUE (a TOML value; none takes the key away; list items by "
                    "index or name)")
        ->take_all()
        ->allow_extra_args(false);
  };
  CLI::App& run_command = *program.add_subcommand("run", "run a scene");
  add_scene(run_command, run.scene, run.overrides);
  run_command.add_option("--out", run.directory, "folder for the results (default: out/NAME-OF-SCENE)");
  run_command.add_option("--threads", run.threads, "threads; 0 (the default) chooses by the work in a step")
      ->check(CLI::Range(0, 1024));
  CLI::Option* resume = run_command.add_flag("--resume", run.resume, "continue from DIR/checkpoint.h5");
  run_command.add_flag("--force", run.force, "replace what an earlier run left in DIR")->excludes(resume);
  run_command.add_flag("--no-fields", run.no_fields, "write no particle data, only series and summary");
  run_command.add_flag("--quiet", run.quiet, "print only warnings and errors");

  CheckOptions check;
  CLI::App& check_command =
      *program.add_subcommand("check", "validate a scene and print what follows from it; run nothing");
  add_scene(check_command, check.scene, check.overrides);
  check_command.add_flag("--json", check.json, "print JSON");

  PointOptions point;
  CLI::App& point_command = *program.add_subcommand("point", "drive one material point along a strain path");
  point_command.add_option("POINT", point.file, "point file (TOML); - is standard input")->required();
  point_command.add_option("--set", point.overrides, "override a key: a.b.c=VALUE (as of run)")
      ->take_all()
      ->allow_extra_args(false);
  point_command.add_option("--out", point.out, "CSV file (default: standard output)");

  std::string result;
  bool json = false;
  CLI::App& info_command = *program.add_subcommand("info", "what a result holds and how it was made");
  info_command.add_option("RESULT", result, "result.h5 or the folder of a run")->required();
  info_command.add_flag("--json", json, "print JSON");

  CompareOptions compared;
  CLI::App& compare_command = *program.add_subcommand(
      "compare", "how far results are from the first: quantities, and fields at common times");
  compare_command.add_option("RESULTS", compared.results, "two results or more")
      ->required()
      ->expected(2, 1000);
  compare_command.add_flag("--last", compared.what.last, "only the last output that both have");
  compare_command.add_option("--fields", compared.what.fields, "only these: a,b,...")
      ->delimiter(',')
      ->take_all()
      ->allow_extra_args(false);
  compare_command
      .add_option("--tolerance", compared.tolerance,
                  "exit status 1 where a field (without fields: a quantity) is further away than this, "
                  "relative to the first")
      ->check(CLI::Validator(
          [](const std::string& text) -> std::string {
            return std::strtod(text.c_str(), nullptr) >= 0.0 ? "" : "found " + text + ", expected 0 or more";
          },
          "NONNEGATIVE"));
  compare_command.add_flag("--json", compared.json, "print JSON");

  bool result_page = false, materials = false;
  std::string schema;
  CLI::App& reference_command =
      *program.add_subcommand("reference", "the scene reference as Markdown, from the program's own tables");
  CLI::Option* of_result =
      reference_command.add_flag("--result", result_page, "the result reference instead");
  reference_command
      .add_flag("--schema{scene}", schema,
                "a JSON schema of scenes instead, for editors; --schema=point: of point files")
      ->check(CLI::IsMember({"scene", "point"}))
      ->excludes(of_result);
  reference_command.add_flag("--materials", materials, "the presets of materials with their sources instead")
      ->excludes(of_result)
      ->excludes("--schema");

  NewOptions fresh;
  CLI::App& new_command = *program.add_subcommand("new", "a commented scene to begin with");
  CLI::Option* named = new_command.add_option("TEMPLATE", fresh.name, "what it is of (default: impact)");
  new_command.add_flag("--list", fresh.list, "the templates that there are")->excludes(named);
  new_command.add_option("--out", fresh.out, "a new file (default: standard output)");

  for (CLI::App* command : program.get_subcommands({})) command->footer(examples_of(command->get_name()));
  program.footer(examples_of(""));

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help
    complain(usage_fault(program, error.what()));
    return exit_input;
  }
  if (new_command) return new_scene(fresh);
  if (run_command) return run_scene(run);
  if (check_command) return check_scene(check);
  if (point_command) return drive_point(point);
  if (compare_command) return compare(compared);
  if (version)
    show(output::version_text());
  else if (info_command)
    show(output::describe_result(result, json));
  else if (!schema.empty())
    show(schema == "point" ? point_schema() : scene_schema());
  else if (reference_command)
    show(result_page ? output::result_reference() : materials ? materials_page() : scene_reference());
  else {
    show(program.help());
    return exit_input;
  }
  return exit_done;
}

}  // namespace

int command_line(int argc, char** argv) {
  std::set_terminate(end_without_handler);
  return guarded([&] { return obey(argc, argv); });
}

}  // namespace vitrum::app
