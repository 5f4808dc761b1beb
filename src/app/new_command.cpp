#include "app/new_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "app/command_line.hpp"
#include "app/messages.hpp"
#include "scene/input_error.hpp"
#include "scene/suggestion.hpp"
#include "vitrum_templates.hpp"

namespace vitrum::app {
namespace {

/// What a template is: its first line, a comment.
std::string_view text_of(const Template& each) {
  const std::string_view line = each.text.substr(0, each.text.find('\n'));
  return line.substr(std::min(line.size(), line.find_first_not_of("# ")));
}

std::string listed() {
  std::size_t width = 0;
  for (const Template& each : templates) width = std::max(width, each.name.size());
  std::string text;
  for (const Template& each : templates) text += fmt::format("{:<{}}  {}\n", each.name, width, text_of(each));
  return text;
}

const Template& template_of(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char letter) { return letter == ' ' || letter == '_'; }, '-');
  const auto* found = std::ranges::find(templates, std::string_view(name), &Template::name);
  if (found != std::end(templates)) return *found;
  std::vector<std::string> names;
  for (const Template& each : templates) names.emplace_back(each.name);
  throw InputError(scene::with_suggestion(
      fmt::format("found an unknown template {}, expected one of {} (see vitrum new --list)", name,
                  fmt::join(names, ", ")),
      name, names));
}

/// Puts the text into a new file: one that is there belongs to whoever wrote it.
void write_new(const std::string& path, std::string_view text) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wx"), &std::fclose);
  if (!file && errno == EEXIST)
    throw InputError(fmt::format("{}: is there already; expected the name of a new file", path));
  if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
      std::fflush(file.get()) != 0)
    throw FileError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
}

}  // namespace

int new_scene(const NewOptions& options) {
  if (options.list) {
    show(listed());
    return exit_done;
  }
  const Template& chosen = template_of(options.name);
  if (options.out.empty())
    show(chosen.text);
  else
    write_new(options.out, chosen.text);
  return exit_done;
}

}  // namespace vitrum::app
