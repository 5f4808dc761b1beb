#include "scene/sha256.hpp"

#include <fstream>

#include "scene/input_error.hpp"
#include "temporary_directory.hpp"
#include "tests/catch.hpp"

using namespace vitrum;

TEST_CASE("SHA-256 agrees with the published examples", "[output]") {
  CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("SHA-256 of a file skips the offset and reports unreadable files", "[output]") {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "file") << "xyabc";
  CHECK(sha256_of_file(directory.path() / "file", 2) == sha256("abc"));
  CHECK_THROWS_AS(sha256_of_file(directory.path() / "absent"), FileError);
}
