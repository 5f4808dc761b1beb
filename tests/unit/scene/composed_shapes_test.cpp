// Shapes put together, cut out and read from pictures.
#include <png.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "scene/input_error.hpp"
#include "scene/read_scene.hpp"
#include "scene/seeding.hpp"
#include "scene/shape_gap.hpp"
#include "scene/shape_measures.hpp"
#include "scene/shapes.hpp"
#include "scene/surface_edges.hpp"
#include "scene/write_scene.hpp"
#include "support/mpm_scene.hpp"
#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double pi = std::numbers::pi;

Region without(Region shape, const std::vector<Region>& holes) {
  shape.holes = holes;
  return shape;
}

Shape random_shape(Random& random) {
  const Vector2 at{random.uniform(4.0, 9.0), random.uniform(0.0, 5.0)};
  const double size = random.uniform(0.5, 3.0);
  switch (random.integer(0, 3)) {
    case 0:
      return Box{at, {at[0] + size, at[1] + random.uniform(0.5, 3.0)}};
    case 1:
      return Disk{at, size};
    case 2:
      return Ring{at, 0.5 * size, size};
    default:
      return Polygon{{at, {at[0] + 0.3 * size, at[1] + size}, {at[0] + size, at[1]}}};
  }
}
/// Of up to three shapes that overlap or not, with up to two holes.
Region random_region(Random& random) {
  Union together;
  for (int n = random.integer(1, 3); n > 0; --n) {
    together.parts.emplace_back(random_shape(random));
    if (random.chance(0.3)) together.parts.back().holes.emplace_back(random_shape(random));
  }
  Region region(together);
  for (int n = random.integer(0, 2); n > 0; --n) region.holes.emplace_back(random_shape(random));
  return region;
}

/// Area and moment by rows of points.
std::array<double, 2> by_points(const Region& region) {
  constexpr int count = 700;
  const Box box = bounds(region);
  const double dx = (box.max[0] - box.min[0]) / count, dy = (box.max[1] - box.min[1]) / count;
  std::array<double, 2> sum{};
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      const Vector2 x{box.min[0] + (i + 0.5) * dx, box.min[1] + (j + 0.5) * dy};
      if (contains(region, x)) sum[0] += dx * dy, sum[1] += x[0] * dx * dy;
    }
  return sum;
}

std::array<double, 2> sums(const std::vector<Seed>& seeds) {
  std::array<double, 2> sum{};
  for (const Seed& seed : seeds) sum[0] += seed.area, sum[1] += seed.area * seed.position[0];
  return sum;
}

/// Integrals of the outward normal over the edges: none over what is closed.
std::array<double, 2> open_ends(const std::vector<Edge>& edges) {
  std::array<double, 2> sum{};
  for (const Edge& edge : edges)
    for (int k = 0; k < 200; ++k) {
      const double angle = edge.normal((k + 0.5) / 200), part = edge.length() / 200;
      sum[0] += part * std::cos(angle), sum[1] += part * std::sin(angle);
    }
  return sum;
}

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

TEST_CASE("regions have the area of their points, a closed edge, and particles of that very mass",
          "[scene]") {
  Random random(31);
  for (int number = 0; number < 150; ++number) {
    const Region region = random_region(random);
    const ShapeMeasures exact = measures(region, Geometry::plane_strain);
    const auto [area, moment] = by_points(region);
    CAPTURE(number, area, exact.area);
    CHECK(exact.area == Approx(area).margin(0.02));
    CHECK(exact.moment == Approx(moment).margin(0.2));
    const auto open = open_ends(edges_of(region, false));
    CHECK(std::abs(open[0]) + std::abs(open[1]) < 1e-3);
    for (const int per_side : {1, 3}) {
      const auto seeds = seed_shape(region, 0.7, per_side, Geometry::plane_strain);
      if (seeds.empty()) {
        CHECK(exact.area < 0.25 * 0.49 / (per_side * per_side) + 1e-12);
        continue;
      }
      CHECK(sums(seeds)[0] == Approx(exact.area).epsilon(1e-7));
      CHECK(sums(seeds)[1] == Approx(exact.moment).epsilon(1e-7));
      CHECK(static_cast<double>(seeds.size()) <= most_seeds(region, 0.7, per_side));
    }
  }
}

TEST_CASE("every edge of a region separates inside from outside", "[scene]") {
  Random random(32);
  for (int number = 0; number < 100; ++number) {
    const Region region = random_region(random);
    CAPTURE(number);
    for (const Edge& edge : edges_of(region, false)) {
      if (edge.length() < 1e-3) continue;
      const Vector2 x = edge.place(0.5);
      const double angle = edge.normal(0.5);
      CHECK(contains(region, {x[0] - 1e-6 * std::cos(angle), x[1] - 1e-6 * std::sin(angle)}));
      CHECK(!contains(region, {x[0] + 1e-6 * std::cos(angle), x[1] + 1e-6 * std::sin(angle)}));
    }
  }
}

TEST_CASE("shapes that share edges, touch or coincide are put together as they should", "[scene]") {
  const auto area = [](const Region& r) { return measures(r, Geometry::plane_strain).area; };
  const auto perimeter = [](const Region& r) { return measures(r, Geometry::plane_strain).perimeter; };
  const auto together = [](std::vector<Region> parts) { return Region(Union{std::move(parts)}); };
  const Box left{{0.1, 0.0}, {1.1, 1.0}}, right{{1.1, 0.0}, {2.3, 1.0}}, tall{{1.1, -1.0}, {2.1, 2.0}};
  CHECK(area(together({left, right})) == Approx(2.2));
  CHECK(perimeter(together({left, right})) == Approx(6.4));
  CHECK(area(together({left, left})) == Approx(1.0));
  CHECK(perimeter(together({left, left})) == Approx(4.0));
  CHECK(area(together({left, tall})) == Approx(4.0));
  CHECK(perimeter(together({left, tall})) == Approx(10.0));
  CHECK(area(without(left, {right})) == Approx(1.0));
  CHECK(perimeter(without(left, {right})) == Approx(4.0));
  CHECK(area(without(left, {left})) == Approx(0.0).margin(1e-14));
  CHECK(edges_of(without(left, {left}), false).empty());
  // A disk that fills a ring's hole; a hole that touches the edge in a point; a disk that touches from
  // outside.
  const Vector2 o{0.3, 0.2};
  CHECK(area(together({Ring{o, 0.7, 1.3}, Disk{o, 0.7}})) == Approx(pi * 1.69));
  CHECK(perimeter(together({Ring{o, 0.7, 1.3}, Disk{o, 0.7}})) == Approx(2.0 * pi * 1.3));
  CHECK(area(without(Disk{o, 1.3}, {Disk{o, 0.7}})) == Approx(pi * (1.69 - 0.49)));
  CHECK(area(without(left, {Disk{{0.6, 0.25}, 0.25}})) == Approx(1.0 - pi / 16.0));
  CHECK(area(together({left, Disk{{0.6, 1.25}, 0.25}})) == Approx(1.0 + pi / 16.0));
  // Half of a disk by a box whose side passes through its centre.
  CHECK(area(without(Disk{o, 1.3}, {Box{{0.3, -5.0}, {5.0, 5.0}}})) == Approx(0.5 * pi * 1.69));
  CHECK(perimeter(without(Disk{o, 1.3}, {Box{{0.3, -5.0}, {5.0, 5.0}}})) == Approx(1.3 * (pi + 2.0)));
}

TEST_CASE("edges of holes are inner, where a hole is closed", "[scene]") {
  const auto inner = [](const Region& region) {
    double length = 0.0;
    for (const Edge& edge : edges_of(region, false)) length += edge.inner() ? edge.length() : 0.0;
    return length;
  };
  const Box slab{{0.0, 0.0}, {4.0, 2.0}};
  CHECK(inner(slab) == 0.0);
  CHECK(inner(without(slab, {Disk{{1.0, 1.0}, 0.5}, Box{{2.0, 0.5}, {3.0, 1.5}}})) == Approx(pi + 4.0));
  CHECK(inner(without(slab, {Disk{{1.0, 2.0}, 0.5}})) == 0.0);  // a notch
  CHECK(inner(Ring{{0.0, 0.0}, 1.0, 2.0}) == Approx(2.0 * pi));
  // Four bars round a window.
  CHECK(inner(Region(Union{{Box{{0.0, 0.0}, {3.0, 1.0}}, Box{{0.0, 2.0}, {3.0, 3.0}},
                            Box{{0.0, 0.5}, {1.0, 2.5}}, Box{{2.0, 0.5}, {3.0, 2.5}}}})) == Approx(4.0));
}

TEST_CASE("of a region about the axis the half beyond it is meant", "[scene]") {
  const Region shell = without(Disk{{0.0, 3.0}, 2.0}, {Disk{{0.0, 3.0}, 1.0}});
  const Region ring(Ring{{0.0, 3.0}, 1.0, 2.0});
  const ShapeMeasures found = measures(shell, Geometry::axisymmetric),
                      expected = measures(ring, Geometry::axisymmetric);
  CHECK(found.area == Approx(expected.area));
  CHECK(found.moment == Approx(expected.moment));
  CHECK(found.perimeter == Approx(expected.perimeter));
  double inner = 0.0;
  for (const Edge& edge : edges_of(shell, true)) inner += edge.inner() ? edge.length() : 0.0;
  CHECK(inner == Approx(pi));
  CHECK(sums(seed_shape(shell, 0.3, 2, Geometry::axisymmetric))[1] == Approx(expected.moment).epsilon(1e-7));
}

TEST_CASE("the gap to a hole is that to its edge", "[scene]") {
  const Region plate = without(Box{{0.0, 0.0}, {10.0, 10.0}}, {Box{{2.0, 2.0}, {8.0, 8.0}}});
  CHECK(gap(plate, Disk{{5.0, 5.0}, 2.5}) == Approx(0.5));
  CHECK(gap(plate, Disk{{12.0, 12.0}, 1.0}) == Approx(std::sqrt(8.0) - 1.0));
  const Region moon = without(Disk{{0.0, 0.0}, 2.0}, {Disk{{1.5, 0.0}, 2.0}});
  CHECK(gap(moon, Disk{{1.5, 0.0}, 1.0}) == Approx(1.0));
  CHECK(gap(moon, Disk{{-4.0, 0.0}, 1.0}) == Approx(1.0));
  CHECK(!common_point(plate, Disk{{5.0, 5.0}, 2.5}, 0.1, 1e-6));
  CHECK(common_point(plate, Disk{{5.0, 5.0}, 3.5}, 0.1, 1e-6));
}

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
