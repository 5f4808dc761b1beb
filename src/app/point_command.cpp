#include "app/point_command.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "app/command_line.hpp"
#include "app/material_warnings.hpp"
#include "app/messages.hpp"
#include "app/point_path.hpp"
#include "scene/input_text.hpp"
#include "scene/read_scene.hpp"

namespace vitrum::app {
namespace {

class Csv {
 public:
  explicit Csv(const std::string& path)
      : name_(path.empty() ? "standard output" : path),
        file_(path.empty() ? stdout : std::fopen(path.c_str(), "w"),
              path.empty() ? [](std::FILE*) { return 0; } : &std::fclose) {
    if (!file_) fail();
  }
  void line(const std::string& text) {
    if (std::fputs(text.c_str(), file_.get()) < 0 || std::fputc('\n', file_.get()) < 0) fail();
  }
  void finish() {
    if (std::fflush(file_.get()) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw FileError(fmt::format("{}: cannot be written: {}", name_, std::strerror(errno)));
  }

  std::string name_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// Whether a column `damage` is added: unless the law stores one of that name.
bool shows_damage(const Material& material) {
  return material.damage_column() && !material.column("damage");
}

/// Columns but `dissipated`, which comes last, whether the material dissipates or not.
std::size_t own_columns(const Material& material) {
  return material.columns().size() - (material.dissipates() ? 1 : 0);
}

std::string header(const Material& material) {
  std::string text = "t,e_rr,e_zz,e_tt,e_rz,s_rr,s_zz,s_tt,s_rz";
  if (shows_damage(material)) text += ",damage";
  for (const Component& column : material.columns().first(own_columns(material)))
    text += fmt::format(",{}", column.name);
  return text + ",dissipated";
}

std::string row(const Material& material, double time, const SymmetricTensor& e, const PointState& s) {
  std::string text = fmt::format("{},{},{},{},{},{},{},{},{}", time, e.rr, e.zz, e.tt, e.rz, s.stress.rr,
                                 s.stress.zz, s.stress.tt, s.stress.rz);
  if (shows_damage(material)) text += fmt::format(",{}", material.damage(s));
  for (std::size_t k = 0; k < own_columns(material); ++k) text += fmt::format(",{}", s.variables[k]);
  return text + fmt::format(",{}", s.dissipated);
}

}  // namespace

int drive_point(const PointOptions& options) {
  const InputText input = show_lines_of(read_input(options.file), options.overrides);
  const PointScene scene = parse_point(input.text, input.name, options.overrides);
  for (const std::string& w : scene.warnings) warn(w);
  const std::shared_ptr<const Material> material = make_material(scene.material, scene.size);
  const std::optional<std::size_t> length = material->column("effective_length");
  if (!length || scene.state.variables[*length] == 0.0)
    for (const std::string& w : material_warnings(scene.material)) warn(w);
  Csv csv(options.out);
  csv.line(header(*material));
  follow_path(scene, *material,
              {[&](double time, const SymmetricTensor& strain, const PointState& state) {
                 csv.line(row(*material, time, strain, state));
               },
               [](EventKind kind, double time) { tell("event {} t={}\n", event_name(kind), time); }});
  csv.finish();
  return exit_done;
}

}  // namespace vitrum::app
