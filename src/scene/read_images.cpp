#include <fmt/format.h>

#include <map>

#include "scene/checks.hpp"
#include "scene/png_greys.hpp"

namespace vitrum::scene {
namespace {

/// Pictures by the names of their files, each read once.
class Pictures {
 public:
  void read(const TableView& table, Region& region) {
    if (auto* image = std::get_if<Image>(&region.shape); image != nullptr && table.sound("image"))
      read(*table.table("image"), *image);
    if (auto* together = std::get_if<Union>(&region.shape)) {
      const std::vector<TableView> parts = table.tables("union");
      for (std::size_t n = 0; n < parts.size(); ++n) read(parts[n], together->parts[n]);
    }
    if (table.schema().find("hole") == nullptr) return;
    const std::vector<TableView> holes = table.tables("hole");
    for (std::size_t n = 0; n < holes.size(); ++n) read(holes[n], region.holes[n]);
  }

 private:
  void read(const TableView& table, Image& image) {
    auto& picture = pictures_[image.file];
    if (!picture.greys) {
      auto found = read_png_greys(table.formulas().folder(), image.file);
      if (const auto* fault = std::get_if<std::string>(&found))
        return table.report(
            "file", "found " + schema::quoted_list({image.file}) + ", expected a PNG picture: " + *fault);
      picture = std::get<0>(std::move(found));
    }
    if (image.sha256.value_or(picture.sha256) != picture.sha256)
      return table.report("sha256",
                          fmt::format("found {} in place of that of '{}' ({}), expected the picture "
                                      "that this scene was resolved with, or no such key",
                                      schema::quoted_list({*image.sha256}), image.file, picture.sha256));
    image.greys = picture.greys, image.sha256 = picture.sha256;
  }

  std::map<std::string, Picture> pictures_;
};

}  // namespace

void read_images(const TableView& document, Scene& scene) {
  Pictures pictures;
  const std::vector<TableView> tables = document.tables("body");
  for (std::size_t i = 0; i < tables.size(); ++i) pictures.read(tables[i], scene.bodies[i]);
}

}  // namespace vitrum::scene
