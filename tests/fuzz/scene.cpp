// Scene files.
#include <cstddef>
#include <cstdint>

#include "promises.hpp"
#include "scene/read_scene.hpp"
#include "short_run.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrum;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::tolerate_refusal([&] { fuzz::exercise(parse_scene(text, "scene.toml")); });
  return 0;
}
