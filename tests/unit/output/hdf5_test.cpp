#include "output/hdf5.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include "contains_text.hpp"
#include "output/atomic_file.hpp"
#include "temporary_directory.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::output;

namespace {
std::string closed(File&& file) {
  const std::span<char> bytes = file.close();
  return {bytes.begin(), bytes.end()};
}
}  // namespace

TEST_CASE("HDF5 arrays, texts and attributes round-trip", "[output]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "größe 1.h5";
  const std::vector<double> table = {0.1, -0.0, 1e-310, 4.0, std::numeric_limits<double>::infinity(), 6.0};
  const std::vector<std::int64_t> integers = {-1, std::numeric_limits<std::int64_t>::max()};
  const std::vector<std::uint32_t> indices = {0, 4294967295U};
  const std::vector<std::string> texts = {"plate", "", "Zylinder ø"};
  {
    File file = File::create(path);
    const Group group = file.root().create_group("a");
    group.write("table", table, 2);
    group.write("integers", integers);
    group.write("indices", indices);
    group.write("empty", std::span<const double>{});
    group.write_text("text", std::string(100000, 'x') + "ü");
    group.write_text("nothing", "");
    group.write_texts("texts", texts);
    group.write_texts("no texts", {});
    group.set_attribute("table", "unit", std::string("m²"));
    group.set_attribute(".", "time", 0.1);
    group.set_attribute(".", "step", std::int64_t{-7});
    put_in_place(path, closed(std::move(file)));
  }
  const File file = File::open_to_read(path);
  const Group group = file.root().open_group("a");
  CHECK(group.read_doubles("table") == table);
  CHECK(std::signbit(group.read_doubles("table")[1]));
  CHECK(group.extent("table").rows == 3);
  CHECK(group.extent("table").columns == 2);
  CHECK(group.read_indices("indices") == indices);
  CHECK(group.read_doubles("empty").empty());
  CHECK(group.read_text("text") == std::string(100000, 'x') + "ü");
  CHECK(group.read_text("nothing").empty());
  CHECK(group.read_texts("texts") == texts);
  CHECK(group.read_texts("no texts").empty());
  CHECK(group.text_attribute("table", "unit") == "m²");
  CHECK(group.number_attribute(".", "time") == 0.1);
  CHECK(group.integer_attribute(".", "step") == -7);
  CHECK(group.has_attribute(".", "time"));
  CHECK_FALSE(group.has_attribute(".", "absent"));
  CHECK(group.names().size() == 8);
}

TEST_CASE("Rows of a series that are never written read as NaN", "[output]") {
  const TemporaryDirectory directory;
  File file = File::create(directory.path() / "s.h5");
  file.root().create_series("late");
  file.root().write_rows("late", 1000, std::vector{5.0});
  file.root().write_rows("late", 3, std::vector{2.0});
  const std::vector<double> rows = file.root().read_doubles("late");
  REQUIRE(rows.size() == 1001);
  CHECK(std::isnan(rows[0]));
  CHECK(rows[3] == 2.0);
  CHECK(rows[1000] == 5.0);
}

TEST_CASE("Rows of a series can be dropped, and written anew", "[output]") {
  File file = File::create("s.h5");
  file.root().create_series("series");
  for (std::size_t row = 0; row < 300; row += 2)
    file.root().write_rows("series", row,
                           std::vector{1.0 * static_cast<double>(row), 1.0 + static_cast<double>(row)});
  file.root().keep_rows("series", 5);
  CHECK_THROWS_WITH(file.root().keep_rows("series", 6), contains_text("has 5 rows, expected 6"));
  file.root().write_rows("series", 5, std::vector{-1.0});
  CHECK(file.root().read_doubles("series") == std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0, -1.0});
}

TEST_CASE("A file in memory goes on from its bytes, which do not change", "[output]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "m.h5";
  std::string bytes = closed(File::create(path));
  for (int n = 0; n < 3; ++n) {
    const std::string before = bytes;
    File file = File::open_image(path, bytes);
    file.root().set_attribute(".", "note " + std::to_string(n), std::int64_t{n});
    const std::string after = closed(std::move(file));
    CHECK(bytes == before);
    bytes = after;
  }
  put_in_place(path, bytes);
  for (int n = 0; n < 3; ++n)
    CHECK(File::open_to_read(path).root().integer_attribute(".", "note " + std::to_string(n)) == n);
}

TEST_CASE("HDF5 errors name the file, the object and the reason", "[output]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "e.h5";
  CHECK_THROWS_WITH(File::open_to_read(path),
                    contains_text("e.h5: cannot open the file as HDF5") && contains_text("No such file"));
  std::ofstream(path) << "no HDF5 at all";
  CHECK_THROWS_AS(File::open_to_read(path), FileError);
  File file = File::create(path);
  file.root().create_group("a").write_text("text", "t");
  file.root().link_to_file("elsewhere", "other.h5", "/");
  CHECK_THROWS_WITH(file.root().open_group("elsewhere"), contains_text("it leads into another file"));
  CHECK_THROWS_WITH(file.root().open_group("a").read_doubles("x"),
                    contains_text("e.h5: /a/x: cannot open the array: "));
  CHECK_THROWS_WITH(file.root().open_group("a").read_doubles("text"),
                    contains_text("/a/text: is not an array of the expected type"));
  CHECK_THROWS_WITH(file.root().open_group("b"), contains_text("/b: cannot open the group"));
  CHECK_THROWS_AS(file.root().create_group("a"), Hdf5Error);
  CHECK_THROWS_AS(file.root().number_attribute("a", "x"), Hdf5Error);
}

TEST_CASE("Arrays that claim more than the file holds are refused without allocating them", "[output]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "huge.h5";
  put_in_place(path, closed(File::create(path)));
  const hid_t raw = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const std::array<hsize_t, 2> size = {hsize_t{1} << 50, 2}, chunk = {1024, 2};
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 2, chunk.data());
  const hid_t space = H5Screate_simple(2, size.data(), nullptr);
  H5Dclose(H5Dcreate2(raw, "huge", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT));
  H5Sclose(space), H5Pclose(creation), H5Fclose(raw);
  const File file = File::open_to_read(path);
  CHECK_THROWS_WITH(file.root().read_doubles("huge"), contains_text("more than the file holds"));
}
