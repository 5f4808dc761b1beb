#include "output/xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "output/atomic_file.hpp"

namespace vitrum::output {
namespace {

std::string_view attribute_type(std::size_t components) {
  if (components == 1) return "Scalar";
  return components == 2 ? "Vector" : "Matrix";
}

std::string data_item(std::string_view number, int bytes, std::size_t rows, std::size_t columns,
                      std::string_view location) {
  return fmt::format(
      R"(<DataItem Format="HDF" NumberType="{}" Precision="{}" Dimensions="{} {}">result.h5:{}</DataItem>)",
      number, bytes, rows, columns, location);
}

std::string grid(const StoredStep& step, std::size_t particles) {
  const std::string fields = fmt::format("/steps/{}/particles/", step.name);
  std::string text = fmt::format(
      "      <Grid Name=\"particles\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n", step.time);
  text += fmt::format(
      "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" "
      "NodesPerElement=\"1\">{}</Topology>\n",
      particles, data_item("UInt", 4, particles, 1, "/particles/index"));
  text += fmt::format("        <Geometry GeometryType=\"XY\">{}</Geometry>\n",
                      data_item("Float", 8, particles, 2, fields + "position"));
  for (const StoredField& field : step.fields) {
    if (field.name == "position") continue;
    text +=
        fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                    field.name, attribute_type(field.components),
                    data_item("Float", 8, particles, field.components, fields + field.name));
  }
  text += fmt::format(
      "        <Attribute Name=\"body\" AttributeType=\"Scalar\" Center=\"Node\">{}</Attribute>\n",
      data_item("UInt", 4, particles, 1, "/particles/body"));
  return text + "      </Grid>\n";
}

}  // namespace

std::string xdmf_text(const ResultFile& result) {
  std::string text =
      "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n"
      "    <Grid Name=\"outputs\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const StoredStep& step : result.steps()) {
    const bool placed = std::any_of(step.fields.begin(), step.fields.end(),
                                    [](const StoredField& field) { return field.name == "position"; });
    if (placed) text += grid(step, result.particles());
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

void write_xdmf(const ResultFile& result) {
  write_text_atomically(std::filesystem::path(result.path()).replace_extension(".xdmf"), xdmf_text(result));
}

}  // namespace vitrum::output
