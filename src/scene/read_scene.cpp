#include "scene/read_scene.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "scene/overrides.hpp"
#include "scene/scene_keys.hpp"
#include "scene/sections.hpp"
#include "scene/toml_text.hpp"

namespace vitrum {
namespace {

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  // A name that leads nowhere is the user's mistake; everything else that goes wrong is the file system's.
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError(fmt::format("{}: found no such file, expected a TOML file", file.string()));
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{}: found a directory, expected a TOML file", file.string()));
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream.is_open() || stream.bad())
    throw FileError(
        fmt::format("{}: cannot be read: {}", file.string(), std::generic_category().message(errno)));
  return text;
}

toml::table parse_document(std::string_view text, std::string_view name,
                           const std::vector<std::string>& overrides, scene::Diagnostics& diagnostics) {
  toml::table document;
  try {
    document = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const toml::source_position where = error.source().begin;
    throw InputError(
        scene::single_line(fmt::format("{}:{}:{}: {}", name, where.line, where.column, error.description())));
  }
  for (std::size_t i = 0; i < overrides.size(); ++i)
    scene::apply_override(document, overrides[i], i + 1, diagnostics);
  return document;
}

}  // namespace

Scene parse_scene(std::string_view text, std::string_view name, const std::vector<std::string>& overrides) {
  scene::Diagnostics diagnostics{std::string(name)};
  const toml::table table = parse_document(text, name, overrides, diagnostics);
  const scene::TableReader document(table, "", scene::keys::scene(), diagnostics);
  Scene scene;
  scene.verbatim = text;
  scene.overrides = overrides;
  document.read("title", scene.title);
  read_space(document, scene);
  read_time(document, scene);
  read_integrator(document, scene);
  read_constitutive(document, scene.constitutive);
  read_output(document, scene);
  read_gravity(document, scene);
  scene.materials = read_materials(document);
  read_bodies(document, scene);
  read_boundaries(document, scene);
  diagnostics.throw_if_any();
  return scene;
}

PointScene parse_point(std::string_view text, std::string_view name,
                       const std::vector<std::string>& overrides) {
  scene::Diagnostics diagnostics{std::string(name)};
  const toml::table table = parse_document(text, name, overrides, diagnostics);
  const scene::TableReader document(table, "", scene::keys::point(), diagnostics);
  PointScene point;
  std::vector<MaterialParameters> materials = read_materials(document);
  if (materials.size() > 1)
    document.report("material", fmt::format("found {} materials, expected one", materials.size()));
  if (!materials.empty()) point.material = std::move(materials.front());
  read_constitutive(document, point.constitutive);
  read_state(document, point);
  read_path(document, point);
  diagnostics.throw_if_any();
  return point;
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return parse_scene(read_text(file), file.string(), overrides);
}

PointScene read_point(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return parse_point(read_text(file), file.string(), overrides);
}

}  // namespace vitrum
