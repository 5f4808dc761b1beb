#include "output/checkpoint.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "contains_text.hpp"
#include "output/atomic_file.hpp"
#include "output/checkpoint_header.hpp"
#include "output/hdf5.hpp"
#include "sample_bodies.hpp"
#include "scene/input_error.hpp"
#include "scene/sha256.hpp"
#include "temporary_directory.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::output;

namespace {

Checkpoint sample_checkpoint() {
  Checkpoint checkpoint{0.1 + 0.2, 123456789012345, "00ff", checkpoint_bodies(sample_bodies()), {}};
  checkpoint.state.put(
      "energy", {1.0 / 3.0, -0.0, 5e-324, std::numeric_limits<double>::max(), INFINITY, std::nan("7")});
  checkpoint.state.put("none", std::vector<double>{});
  checkpoint.state.put("one", 1.0);
  checkpoint.state.put_text("first_damage", "plate ø");
  checkpoint.state.put_text("empty", "");
  return checkpoint;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

TEST_CASE("A checkpoint restores every bit", "[output]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "checkpoint.h5";
  const Checkpoint written = sample_checkpoint();
  write_checkpoint(path, written);
  write_checkpoint(path, written);
  CHECK_FALSE(std::filesystem::exists(next_of(path)));
  const Checkpoint read = read_checkpoint(path);
  CHECK(read.time == written.time);
  CHECK(read.step_index == written.step_index);
  CHECK(read.scene_sha256 == written.scene_sha256);
  CHECK(read.state.all_texts() == written.state.all_texts());
  REQUIRE(read.state.all_numbers().size() == written.state.all_numbers().size());
  for (const auto& [name, values] : written.state.all_numbers())
    CHECK(same_bits(read.state.numbers(name, values.size()), values));
  REQUIRE(read.bodies.size() == 2);
  CHECK(read.bodies[0].name == "plate");
  CHECK(read.bodies[0].particles.identity == std::vector<std::uint32_t>{2, 0, 1});

  std::vector<Body> bodies = sample_bodies();
  const std::vector<Body> expected = sample_bodies();
  for (Body& body : bodies) {
    std::fill(body.particles.velocity[1].begin(), body.particles.velocity[1].end(), 0.0);
    std::fill(body.particles.elastic_strain[3].begin(), body.particles.elastic_strain[3].end(), 0.0);
    std::sort(body.particles.identity.begin(), body.particles.identity.end());
    body.particles.spin_increment.assign(body.particles.size, 9.0);
  }
  restore_bodies(read, bodies);
  for (std::size_t b = 0; b < 2; ++b) {
    const Particles &found = bodies[b].particles, &wanted = expected[b].particles;
    CHECK(found.identity == wanted.identity);
    CHECK(found.position == wanted.position);
    CHECK(found.velocity == wanted.velocity);
    CHECK(found.mass == wanted.mass);
    CHECK(found.elastic_strain == wanted.elastic_strain);
    CHECK(found.variables == wanted.variables);
    CHECK(found.spin_increment.size() == found.size);
  }
}

TEST_CASE("A checkpoint of another scene is refused with the difference", "[output]") {
  const Checkpoint checkpoint = sample_checkpoint();
  std::vector<Body> bodies = sample_bodies();
  bodies.pop_back();
  CHECK_THROWS_WITH(restore_bodies(checkpoint, bodies), contains_text("bodies: found 2, expected 1"));
  bodies = sample_bodies();
  bodies[1].name = "ball";
  CHECK_THROWS_WITH(restore_bodies(checkpoint, bodies), contains_text("found cylinder, expected ball"));
  bodies = sample_bodies();
  bodies[0].particles.size = 4;
  CHECK_THROWS_WITH(restore_bodies(checkpoint, bodies),
                    contains_text("particles of body 'plate': found 3, expected 4"));
  bodies = sample_bodies();
  bodies[0] = sample_body("plate", "plastic_strain", false, {2, 0, 1});
  CHECK_THROWS_WITH(restore_bodies(checkpoint, bodies),
                    contains_text("found crack_density, dissipated, expected dissipated, plastic_strain"));
}

TEST_CASE("Altered, truncated and foreign checkpoints are refused", "[output]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "checkpoint.h5";
  write_checkpoint(path, sample_checkpoint());
  const std::string intact = content(path);
  CHECK_THROWS_WITH(read_checkpoint(directory.path() / "absent"), contains_text("absent: cannot read"));
  for (std::size_t length = 0; length < intact.size(); length += 97) {
    put(path, intact.substr(0, length));
    CHECK_THROWS_AS(read_checkpoint(path), FileError);
  }
  for (std::size_t position = 512; position < intact.size(); position += 211) {
    std::string altered = intact;
    altered[position] = static_cast<char>(altered[position] ^ 4);
    put(path, altered);
    CHECK_THROWS_WITH(read_checkpoint(path),
                      contains_text("is truncated or damaged: its content does not match its SHA-256; "
                                    "--force instead of --resume starts anew"));
  }
  put(path, "title = \"a scene\"\n");
  CHECK_THROWS_WITH(read_checkpoint(path), contains_text("is not a checkpoint of this version"));
  CHECK_THROWS_AS(read_checkpoint(directory.path()), FileError);
}

TEST_CASE("A checkpoint whose columns disagree is refused", "[output]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "checkpoint.h5";
  Checkpoint checkpoint = sample_checkpoint();
  checkpoint.bodies[0].particles.mass.pop_back();
  write_checkpoint(path, checkpoint);
  CHECK_THROWS_WITH(read_checkpoint(path), contains_text("'mass' has 2 entries, expected 3"));
  const auto empty = directory.path() / "empty.h5";
  File file = File::create(empty, checkpoint_header_size);
  const std::span<char> closed = file.close();
  std::string bytes(closed.begin(), closed.end());
  bytes.replace(0, 92, checkpoint_header(sha256(bytes.substr(512))));
  put(empty, bytes);
  CHECK_THROWS_AS(read_checkpoint(empty), FileError);
}

TEST_CASE("A checkpoint whose digest is right but whose content no run writes is refused", "[output]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "checkpoint.h5";
  Checkpoint checkpoint = sample_checkpoint();
  checkpoint.time = std::numeric_limits<double>::quiet_NaN();
  write_checkpoint(path, checkpoint);
  CHECK_THROWS_WITH(read_checkpoint(path), contains_text("its time is nan"));
  std::vector<Body> bodies = sample_bodies();
  checkpoint = {};
  checkpoint.bodies = checkpoint_bodies(bodies);
  for (const std::uint32_t wrong : {1U, 4000000000U}) {
    checkpoint.bodies[0].particles.identity[0] = wrong;
    CHECK_THROWS_WITH(restore_bodies(checkpoint, bodies), contains_text("each from 0 to"));
  }
}

TEST_CASE("A state is asked for by name", "[output]") {
  Archive archive;
  archive.put("energy.plastic", 2.5);
  archive.put("steps", 7.0);
  archive.put("place", {1.0, 2.0});
  CHECK(archive.number("energy.plastic") == 2.5);
  CHECK(archive.count("steps") == 7);
  CHECK(archive.numbers("place", 2)[1] == 2.0);
  CHECK_THROWS_WITH(archive.number("energy.elastic"), contains_text("'energy.elastic' is missing"));
  CHECK_THROWS_WITH(archive.numbers("place", 3), contains_text("holds 2 numbers, expected 3"));
  CHECK_THROWS_WITH(archive.count("energy.plastic"), contains_text("2.5, which is no count"));
  CHECK_THROWS_WITH(archive.text("scene"), contains_text("'scene' is missing"));
  CHECK_THROWS_AS(archive.put("steps", 8.0), std::logic_error);
  for (const char* name : {"a/b", "a b", "a\n", "", "."})  // paths of HDF5, and what separates names
    CHECK_THROWS_AS(archive.put(name, 1.0), std::invalid_argument);
}
