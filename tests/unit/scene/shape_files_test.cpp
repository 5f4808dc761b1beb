// Shapes as scenes tell them: unions, holes, pictures, corners in files.
#include <png.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "scene/input_error.hpp"
#include "scene/read_scene.hpp"
#include "scene/shape_measures.hpp"
#include "scene/write_scene.hpp"
#include "support/mpm_scene.hpp"
#include "support/random_states.hpp"
#include "support/region_measures.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double pi = std::numbers::pi;

void write_png(const std::string& file, int columns, int rows, const std::vector<unsigned char>& levels) {
  png_image picture{};
  picture.version = PNG_IMAGE_VERSION, picture.format = PNG_FORMAT_GRAY;
  picture.width = static_cast<unsigned>(columns), picture.height = static_cast<unsigned>(rows);
  REQUIRE(png_image_write_to_file(&picture, file.c_str(), 0, levels.data(), 0, nullptr) != 0);
}

/// A folder for a test's files.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / (name + std::to_string(std::random_device()()))) {
    std::filesystem::create_directory(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

MpmScene scene_of(const std::string& shape, const std::string& more = "") {
  MpmScene scene;
  scene.tables = body("body", shape, more);
  return scene;
}
Scene read(const std::string& shape, const std::string& name = "test.toml") {
  return parse_scene(scene_of(shape).text(), name);
}
std::string fault(const std::string& shape, const std::string& name = "test.toml") {
  try {
    read(shape, name);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a picture's pixels are a body, to the last of them", "[scene]") {
  const Folder folder("vitrum_pictures");
  Random random(33);
  constexpr int columns = 23, rows = 17;
  std::vector<unsigned char> levels;
  for (int k = 0; k < columns * rows; ++k)
    levels.push_back(static_cast<unsigned char>(random.integer(0, 3) * 80));
  write_png(folder.file("paving.png"), columns, rows, levels);
  double all = 0.0;
  for (const int level : {0, 1, 2, 3}) {
    const std::string shape =
        fmt::format("image = {{file = \"paving.png\", corner = [1.5, -2.0], width = 11.5, grey = [{}, {}]}}",
                    80 * level, 80 * level + 1);
    const Scene scene = read(shape, folder.file("scene.toml"));
    const Region& region = scene.bodies[0];
    const double pixel = 0.5;
    double area = 0.0, moment = 0.0;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        const Vector2 middle{1.5 + (i + 0.5) * pixel, -2.0 + (rows - 1 - j + 0.5) * pixel};
        const bool expected = levels[static_cast<std::size_t>(j * columns + i)] == 80 * level;
        REQUIRE(contains(region, middle) == expected);
        if (expected) area += pixel * pixel, moment += middle[0] * pixel * pixel;
      }
    all += area;
    CHECK(measures(region, Geometry::plane_strain).area == Approx(area).epsilon(1e-12));
    CHECK(measures(region, Geometry::plane_strain).moment == Approx(moment).epsilon(1e-12));
    for (const double cell : {0.5, 0.3, 1.7}) {
      const auto found = sums(seed_shape(region, cell, 1, Geometry::plane_strain));
      CHECK(found[0] == Approx(area).epsilon(1e-7));
      CHECK(found[1] == Approx(moment).epsilon(1e-7));
    }
    const auto open = open_ends(edges_of(region, false));
    CHECK(std::abs(open[0]) + std::abs(open[1]) < 1e-10);
    // A disk cut out of it.
    const Region cut = without(region, {Disk{{6.0, 2.0}, 2.2}});
    CHECK(sums(seed_shape(cut, 0.3, 1, Geometry::plane_strain))[0] == Approx(by_points(cut)[0]).margin(0.3));
    CHECK(resolved_toml(scene).find(
              "image = {file = \"paving.png\", corner = [1.5, -2.0], width = 11.5, grey = [") !=
          std::string::npos);
  }
  CHECK(all == Approx(11.5 * 8.5));
  const auto image = [&](const std::string& name, const std::string& grey) {
    return fault(fmt::format("image = {{file = \"{}\", width = 1.0, grey = {}}}", name, grey),
                 folder.file("scene.toml"));
  };
  CHECK(
      image("none.png", "[0, 1]").find("body.0.image.file': found \"none.png\", expected a PNG picture: ") !=
      std::string::npos);
  CHECK(image("paving.png", "[1, 2]")
            .find("found no pixel of such a level in 'paving.png', expected some (they "
                  "are from 0 to 240)") != std::string::npos);
  CHECK(image("paving.png", "[2, 1]").find("the lowest level") != std::string::npos);
  std::ofstream(folder.file("text.png")) << "no picture";
  CHECK(image("text.png", "[0, 1]").find("Not a PNG file") != std::string::npos);
  CHECK(image("other.png", "[0, 1]").find("found no such file, expected a PNG picture") != std::string::npos);
  // A resolved scene is one of this picture.
  const std::string resolved = resolved_toml(
      read("image = {file = \"paving.png\", width = 1.0, grey = [0, 1]}", folder.file("scene.toml")));
  CHECK(parse_scene(resolved, folder.file("scene.toml")).bodies[0].shape.index() == 4);
  levels[0] = static_cast<unsigned char>(levels[0] ^ 1);
  write_png(folder.file("paving.png"), columns, rows, levels);
  CHECK_THROWS_WITH(
      parse_scene(resolved, folder.file("scene.toml")),
      Catch::Contains("body.0.image.sha256': found ") && Catch::Contains("expected the picture that"));
}

TEST_CASE("a polygon is read from a file, and needs three corners", "[scene]") {
  const Folder folder("vitrum_polygons");
  std::ofstream(folder.file("corners.csv")) << "x,y\n0,0\n3,0\n0,2\n";
  std::ofstream(folder.file("two.csv")) << "0,0\n3,0\n";
  const Scene scene = read("polygon = {csv = \"corners.csv\"}", folder.file("scene.toml"));
  CHECK(std::get<Polygon>(scene.bodies[0].shape).vertices ==
        std::vector<Vector2>{{0.0, 0.0}, {3.0, 0.0}, {0.0, 2.0}});
  CHECK(measures(scene.bodies[0], Geometry::plane_strain).area == Approx(3.0));
  CHECK(resolved_toml(scene).find("polygon = [[0.0, 0.0], [3.0, 0.0], [0.0, 2.0]]  # corners.csv") !=
        std::string::npos);
  CHECK(fault("polygon = {csv = \"two.csv\"}", folder.file("scene.toml")).find("2 vertices") !=
        std::string::npos);
  CHECK(fault("polygon = {csv = \"none.csv\"}", folder.file("scene.toml")).find("none.csv") !=
        std::string::npos);
  CHECK(fault("polygon = [[0, 0], [1, 0]]")
            .find("found a list of 2, expected a list of three or more vertices") != std::string::npos);
}

TEST_CASE("unions and holes are read, written and told where they are wrong", "[scene]") {
  const std::string shape =
      "union = [{box = {min = [0, 0], max = [4, 1]}, hole = {disk = {centre = [1, 0.5], radius = 0.2}}}, "
      "{disk = {centre = [4, 0.5], radius = 1}}]\n"
      "hole = [{box = {min = [2, -1], max = [2.5, 0.5]}}, {ring = {centre = [4, 0.5], inner = 0.1, outer = "
      "0.2}}]";
  const Scene scene = read(shape);
  const auto& parts = std::get<Union>(scene.bodies[0].shape).parts;
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].holes.size() == 1);
  CHECK(scene.bodies[0].holes.size() == 2);
  // The half of the disk that lies over the box is a strip of 1 between its chords.
  CHECK(measures(scene.bodies[0], Geometry::plane_strain).area ==
        Approx(4.0 - 0.04 * pi + pi - (0.5 * std::sqrt(0.75) + pi / 6.0) - 0.25 - 0.03 * pi));
  const std::string text = resolved_toml(scene);
  CHECK(text.find("union = [{box = {min = [0.0, 0.0], max = [4.0, 1.0]}, hole = [{disk = {centre = [1.0, "
                  "0.5], radius = "
                  "0.2}}]}, {disk = ") != std::string::npos);
  CHECK(resolved_toml(parse_scene(text, "resolved.toml")) == text);
  CHECK(fault("box = {min = [0, 0], max = [1, 1]}\nhole = {disk = {centre = [0, 0]}}")
            .find("key 'body.0.hole.disk.radius': found nothing") != std::string::npos);
  CHECK(fault("box = {min = [0, 0], max = [1, 1]}\nhole = [{disk = {centre = [0, 0], radius = 0.1}}, {}]")
            .find("key 'body.0.hole.1': found no shape") != std::string::npos);
  CHECK(fault("union = [{ring = {centre = [0, 0], inner = 2, outer = 1}}]")
            .find("key 'body.0.union.0.ring.outer'") != std::string::npos);
  CHECK(fault("union = []").find("found an empty list, expected a list of shapes") != std::string::npos);
  CHECK(fault("union = [{union = [{box = {min = [0, 0], max = [1, 1]}}]}]").find("found an unknown key") !=
        std::string::npos);
  CHECK(fault("box = {min = [0, 0], max = [1, 1]}\nhole = {polygon = [[0, 0], [1, 1], [1, 0], [0, 2]]}")
            .find("key 'body.0.hole.polygon': found edges") != std::string::npos);
  const auto warnings =
      read("box = {min = [0, 0], max = [1, 1]}\nhole = {disk = {centre = [5, 5], radius = 1}}").warnings;
  CHECK(std::ranges::count_if(warnings, [](const std::string& warning) {
          return warning.find("key 'body.0.hole.disk': found it outside 'body.0.box'") != std::string::npos;
        }) == 1);
}
