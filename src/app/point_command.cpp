#include "app/point_command.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "app/command_line.hpp"
#include "mpm/computation_error.hpp"
#include "scene/local_method.hpp"
#include "scene/read_scene.hpp"

namespace vitrum::app {
namespace {

class Csv {
 public:
  explicit Csv(const std::string& path)
      : path_(path),
        file_(path.empty() ? stdout : std::fopen(path.c_str(), "w"),
              path.empty() ? [](std::FILE*) { return 0; } : &std::fclose) {
    if (!file_) throw FileError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  }
  void line(const std::string& text) {
    if (std::fputs(text.c_str(), file_.get()) < 0 || std::fputc('\n', file_.get()) < 0)
      throw FileError(fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
  }
  void finish() {
    if (std::fflush(file_.get()) != 0)
      throw FileError(fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
  }

 private:
  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

std::string header(const Material& material) {
  std::string text = "t,e_rr,e_zz,e_tt,e_rz,s_rr,s_zz,s_tt,s_rz";
  if (material.parameters().damage) text += ",damage";
  for (const VariableInfo& v : material.variables())
    if (v.variable != Variable::dissipated) text += fmt::format(",{}", v.name);
  return text + ",dissipated";
}

std::string row(const Material& material, double time, const SymmetricTensor& e, const PointState& s) {
  std::string text = fmt::format("{},{},{},{},{},{},{},{},{}", time, e.rr, e.zz, e.tt, e.rz, s.stress.rr,
                                 s.stress.zz, s.stress.tt, s.stress.rz);
  if (material.parameters().damage) text += fmt::format(",{}", material.damage(s));
  for (const VariableInfo& v : material.variables())
    if (v.variable != Variable::dissipated)
      text += fmt::format(",{}", s.*variable_members[static_cast<std::size_t>(v.variable)]);
  return text + fmt::format(",{}", s.dissipated);
}

}  // namespace

int drive_point(const PointOptions& options) {
  const PointScene scene = read_point(options.file, options.overrides);
  const std::shared_ptr<const Material> material = make_material(scene.material, scene.size);
  const std::unique_ptr<LocalIntegrator> local = make_local_integrator(scene.constitutive);
  Csv csv(options.out);
  csv.line(header(*material));

  PointState state = scene.state;
  state.stress = material->secant_moduli(state).stress(state.elastic_strain);
  SymmetricTensor strain = scene.strain[0];
  double time = scene.time[0];
  const auto advance = [&](double to, const SymmetricTensor& target) {
    PointReport report;
    local->integrate(*material, state, target - strain, to - time, report);
    if (report.failed())
      throw ComputationError(
          fmt::format("t = {} s: {}; try constitutive.method = \"closed-form\", a larger constitutive.rtol, "
                      "or a finer strain path",
                      time, report.cause));
    for (std::size_t k = 0; k < report.event_count; ++k)
      fmt::print(stderr, "event {} t={}\n", event_name(report.events[k].kind),
                 time + report.events[k].fraction * (to - time));
    if (!std::isfinite(trace(state.stress) + state.stress.rz + state.dissipated))
      throw ComputationError(
          fmt::format("t = {} s: the stress is not finite (strain {}, {}, {}, {}); reduce the strain path",
                      to, target.rr, target.zz, target.tt, target.rz));
    strain = target;
    time = to;
  };
  // A path that does not start at zero strain starts with a jump to its first point.
  if (strain != SymmetricTensor{}) {
    const SymmetricTensor first = strain;
    strain = {};
    advance(time, first);
  }
  csv.line(row(*material, time, strain, state));
  for (std::size_t segment = 0; segment + 1 < scene.time.size(); ++segment) {
    const double t0 = scene.time[segment], t1 = scene.time[segment + 1];
    const SymmetricTensor e0 = scene.strain[segment], change = scene.strain[segment + 1] - e0;
    for (int k = 1; k <= scene.samples; ++k) {
      const double f = static_cast<double>(k) / scene.samples;
      advance(k == scene.samples ? t1 : t0 + f * (t1 - t0),
              k == scene.samples ? scene.strain[segment + 1] : e0 + f * change);
      csv.line(row(*material, time, strain, state));
    }
  }
  csv.finish();
  return exit_done;
}

}  // namespace vitrum::app
