#include "output/xdmf.hpp"

#include <fmt/format.h>

#include "output/result_layout.hpp"

namespace vitrum::output {
namespace {

constexpr const char* xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string_view attribute_type(std::size_t components) {
  if (components == 1) return "Scalar";
  return components == 3 ? "Vector" : "Matrix";
}

std::string data_item(std::string_view number, int bytes, std::size_t rows, std::size_t columns,
                      const std::string& location) {
  return fmt::format(
      R"(<DataItem Format="HDF" NumberType="{}" Precision="{}" Dimensions="{}{}">steps/{}</DataItem>)",
      number, bytes, rows, columns == 1 ? "" : fmt::format(" {}", columns), location);
}

std::string block(std::size_t step, std::size_t number, const DrawnBody& body) {
  const std::string group = fmt::format(".h5:/drawn/{}/", number), constants = "particles" + group,
                    output = step_name(step) + group;
  std::string text = fmt::format(
      "  <Grid Name=\"{}\" GridType=\"Uniform\">\n"
      "    <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" "
      "NodesPerElement=\"1\">{}</Topology>\n",
      escaped(body.name), body.particles, data_item("UInt", 4, body.particles, 1, constants + "index"));
  for (const DrawnArray& array : body.arrays) {
    const std::string data = data_item("Float", 8, body.particles, array.components,
                                       (array.constant ? constants : output) + array.name);
    if (array.name == "position")
      text += fmt::format("    <Geometry GeometryType=\"XY\">{}</Geometry>\n", data);
    else
      text += fmt::format("    <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                          array.name, attribute_type(array.components), data);
  }
  return text + "  </Grid>\n";
}

}  // namespace

std::string step_xdmf(std::size_t index, double time, const std::vector<DrawnBody>& bodies) {
  std::string text = fmt::format(
      "{}<Grid Name=\"bodies\" GridType=\"Collection\" CollectionType=\"Spatial\">\n  <Time Value=\"{}\"/>\n",
      xml, time);
  for (std::size_t number = 0; number < bodies.size(); ++number) text += block(index, number, bodies[number]);
  return text + "</Grid>\n";
}

std::string xdmf_text(const std::vector<std::size_t>& drawn) {
  std::string text = fmt::format(
      "{}<Xdmf Version=\"2.0\" xmlns:xi=\"http://www.w3.org/2001/XInclude\">\n  <Domain>\n"
      "    <Grid Name=\"outputs\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
      xml);
  for (const std::size_t index : drawn)
    text +=
        fmt::format("      <xi:include href=\"steps/{}.xmf\" xpointer=\"element(/1)\"/>\n", step_name(index));
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace vitrum::output
