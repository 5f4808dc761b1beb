#include "scene/write_scene.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <optional>
#include <span>

#include "materials/registry.hpp"
#include "scene/choices.hpp"
#include "scene/key_info.hpp"
#include "scene/toml_text.hpp"

namespace vitrum {
namespace {

using namespace scene;

std::string value_text(double value) {
  return number_text(value);
}
std::string value_text(int value) {
  return std::to_string(value);
}
std::string value_text(bool value) {
  return value ? "true" : "false";
}
std::string value_text(std::string_view text) {
  return toml_quoted(text);
}
std::string value_text(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number_text(value);
  return '[' + text + ']';
}
std::string value_text(const Vector2& vector) {
  return value_text(std::span<const double>(vector));
}
std::string value_text(std::span<const Vector2> rows) {
  std::string text;
  for (const Vector2& row : rows) text += (text.empty() ? "" : ", ") + value_text(row);
  return '[' + text + ']';
}
std::string value_text(const Box& box) {
  return fmt::format("{{min = {}, max = {}}}", value_text(box.min), value_text(box.max));
}
std::string value_text(const Disk& disk) {
  return fmt::format("{{centre = {}, radius = {}}}", value_text(disk.centre), number_text(disk.radius));
}
std::string value_text(const Ring& ring) {
  return fmt::format("{{centre = {}, inner = {}, outer = {}}}", value_text(ring.centre),
                     number_text(ring.inner), number_text(ring.outer));
}

std::string value_text(const Perturbation& perturbation) {
  return fmt::format("{{amplitude = {}, seed = {}}}", number_text(perturbation.amplitude), perturbation.seed);
}

class TomlWriter {
 public:
  void header(std::string_view text) { text_ += fmt::format("{}{}\n", text_.empty() ? "" : "\n", text); }

  template <class Value>
  void line(std::string_view key, const Value& value) {
    text_ += fmt::format("{} = {}\n", key, value_text(value));
  }
  template <class Value>
  void line(std::string_view key, const std::optional<Value>& value) {
    if (value) line(key, *value);
  }
  void raw(std::string_view key, std::string_view value) { text_ += fmt::format("{} = {}\n", key, value); }

  template <class Parameters>
  void parameters(const Parameters& values) {
    for (const ParameterInfo<Parameters>& info : Parameters::describe()) line(info.name, values.*info.member);
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void write_integrator(TomlWriter& out, const IntegratorDefinition& integrator) {
  out.header("[integrator]");
  out.line("method", name_of(grid_method_names, integrator.method));
  out.line("scheme", name_of(scheme_names, integrator.scheme));
  out.line("step", integrator.step);
  out.line("courant", integrator.courant);
  out.line("max_growth", integrator.max_growth);
  if (integrator.table)
    out.line("table", integrator.table);
  else
    out.line("order", integrator.order);
  out.line("rtol", integrator.rtol);
  out.line("velocity_scale", integrator.velocity_scale);
  out.line("strain_scale", integrator.strain_scale);
  out.line("fixed_step", integrator.fixed_step);
  out.line("max_step", integrator.max_step);
  out.line("min_step", integrator.min_step);
  out.line("initial_step", integrator.initial_step);
  out.line("linear_solver", integrator.linear_solver);
  out.line("preconditioner", integrator.preconditioner);
  out.line("remap", integrator.remap);
  out.line("remap_travel", integrator.remap_travel);
  out.line("remap_strain", integrator.remap_strain);
}

void write_constitutive(TomlWriter& out, const ConstitutiveDefinition& constitutive) {
  out.header("[constitutive]");
  out.line("method", name_of(local_method_names, constitutive.method));
  out.line("rtol", constitutive.rtol);
  out.line("atol", constitutive.atol);
  out.line("solver", constitutive.solver);
}

void write_output(TomlWriter& out, const OutputDefinition& output) {
  out.header("[output]");
  out.line("every", output.every);
  if (output.fields) out.raw("fields", '[' + quoted_list(*output.fields) + ']');
  out.line("checkpoint_every", output.checkpoint_every);
}

void write_body(TomlWriter& out, const BodyDefinition& body) {
  out.header("[[body]]");
  out.line("name", body.name);
  out.line("material", body.material);
  if (const auto* box = std::get_if<Box>(&body.shape)) out.line("box", *box);
  if (const auto* disk = std::get_if<Disk>(&body.shape)) out.line("disk", *disk);
  if (const auto* ring = std::get_if<Ring>(&body.shape)) out.line("ring", *ring);
  if (const auto* polygon = std::get_if<Polygon>(&body.shape))
    out.line("polygon", std::span<const Vector2>(polygon->vertices));
  out.line("particles_per_cell", body.particles_per_cell);
  out.line("velocity", body.velocity);
  out.line("velocity_gradient", std::span<const Vector2>(body.velocity_gradient));
  out.line("stress", std::span<const double>(body.stress));
  if (body.perturbation.amplitude > 0.0) out.line("perturbation", body.perturbation);
}

void write_boundary(TomlWriter& out, const BoundaryDefinition& boundary, Geometry geometry) {
  out.header("[[boundary]]");
  out.line("name", boundary.name);
  out.line("box", boundary.box);
  std::vector<std::string> fixed;
  for (std::size_t i = 0; i < 2; ++i)
    if (boundary.fixed[i]) fixed.emplace_back(component_names(geometry)[i]);
  out.raw("fix", '[' + quoted_list(fixed) + ']');
  out.line("velocity", boundary.velocity);
  out.line("moves", boundary.moves);
  out.line("priority", boundary.priority);
}

void write_contact(TomlWriter& out, const ContactDefinition& contact) {
  if (!contact.stated) return;
  out.header("[contact]");
  out.line("method", name_of(contact_method_names, contact.method));
  out.line("friction", contact.friction);
  out.line("stiffness", contact.stiffness);
  out.line("depth", contact.depth);
  if (contact.slip_speed) out.line("slip_speed", *contact.slip_speed);
  for (const ContactPair& pair : contact.pairs) {
    out.header("[[contact.pair]]");
    out.raw("bodies", fmt::format("[{}, {}]", toml_quoted(pair.bodies[0]), toml_quoted(pair.bodies[1])));
    out.line("friction", pair.friction);
  }
}

void write_material(TomlWriter& out, const MaterialParameters& material) {
  const std::string table = join_path("material", material.name);
  const auto model = [&](std::string_view name) { out.header(fmt::format("[{}.{}]", table, name)); };
  out.header(fmt::format("[{}]", table));
  out.parameters(material.elastic);
  if (material.damage) {
    model("damage");
    out.parameters(*material.damage);
    if (material.damage->fixed_rate > 0.0)
      out.raw("rate", fmt::format("{{fixed = {}}}", number_text(material.damage->fixed_rate)));
    else
      out.line("rate", rate_names[0]);
  }
  if (material.drucker_prager) {
    model("drucker_prager");
    out.parameters(*material.drucker_prager);
    out.line("flow", name_of(flow_names, material.drucker_prager->associated));
  }
  if (material.von_mises) {
    model("von_mises");
    out.parameters(*material.von_mises);
  }
  if (material.decohesion) {
    model("decohesion");
    out.parameters(*material.decohesion);
    out.line("plane", name_of(plane_names, material.decohesion->search_all_planes));
  }
  if (material.law) {
    model(material.law->table);
    const RegisteredLaw& law = *find_law(material.law->table);
    for (std::size_t k = 0; k < law.parameters.size(); ++k) {
      const std::vector<double>& value = material.law->values[k];
      if (law.parameters[k].is_list)
        out.line(law.parameters[k].name, std::span<const double>(value));
      else
        out.line(law.parameters[k].name, value.front());
    }
  }
}

}  // namespace

std::string resolved_toml(const Scene& scene) {
  TomlWriter out;
  out.line("title", scene.title);
  out.header("[space]");
  out.line("geometry", name_of(geometry_names, scene.geometry));
  out.line("cell", scene.cell);
  out.line("shape_functions", name_of(shape_function_names, scene.shape_functions));
  out.header("[time]");
  out.line("start", scene.start);
  out.line("end", scene.end);
  write_integrator(out, scene.integrator);
  write_constitutive(out, scene.constitutive);
  write_output(out, scene.output);
  for (const BodyDefinition& body : scene.bodies) write_body(out, body);
  for (const BoundaryDefinition& boundary : scene.boundaries) write_boundary(out, boundary, scene.geometry);
  write_contact(out, scene.contact);
  out.header("[gravity]");
  out.line("acceleration", scene.gravity);
  for (const MaterialParameters& material : scene.materials) write_material(out, material);
  return out.take();
}

std::string point_toml(const PointScene& point) {
  TomlWriter out;
  write_material(out, point.material);
  write_constitutive(out, point.constitutive);
  out.header("[state]");
  const auto components = [](const SymmetricTensor& a) {
    return std::array<double, 4>{a.rr, a.zz, a.tt, a.rz};
  };
  out.line("elastic_strain", std::span<const double>(components(point.state.elastic_strain)));
  const std::shared_ptr<const Material> material = make_material(point.material, point.size);
  for (std::size_t k = 0; k < material->columns().size(); ++k)
    out.line(material->columns()[k].name, value_of(*material, point.state, k));
  out.header("[path]");
  out.line("time", std::span<const double>(point.time));
  std::string rows;
  for (const SymmetricTensor& e : point.strain)
    rows += (rows.empty() ? "" : ", ") + value_text(std::span<const double>(components(e)));
  out.raw("strain", '[' + rows + ']');
  out.line("size", point.size);
  out.line("samples", point.samples);
  return out.take();
}

}  // namespace vitrum
