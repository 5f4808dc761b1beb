#include "scene/png_greys.hpp"

#include <fmt/format.h>
#include <png.h>

#include "scene/input_text.hpp"
#include "scene/sha256.hpp"

namespace vitrum::scene {
namespace {

constexpr std::int64_t most_pixels = 16'000'000;

/// libpng's state, which it frees itself once all has been read.
struct Decoder : png_image {
  Decoder() : png_image{} { version = PNG_IMAGE_VERSION; }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() { png_image_free(this); }
};

}  // namespace

std::variant<Picture, std::string> read_png_greys(const std::filesystem::path& folder,
                                                  const std::string& name) {
  const std::string file = (folder / name).string();
  std::string bytes;
  try {
    bytes = read_file(file, "a PNG picture");
  } catch (const std::runtime_error& error) {
    return std::string(error.what());
  }
  Decoder picture;
  if (png_image_begin_read_from_memory(&picture, bytes.data(), bytes.size()) == 0)
    return fmt::format("{}: {}", file, picture.message);
  auto greys = std::make_shared<Greys>();
  greys->columns = picture.width, greys->rows = picture.height;
  if (greys->columns * greys->rows > most_pixels)
    return fmt::format("{}: found {} x {} pixels, expected at most {}", file, greys->columns, greys->rows,
                       most_pixels);
  picture.format = PNG_FORMAT_GRAY;
  picture.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // levels of 16 bits mean what those of 8 do
  greys->levels.resize(static_cast<std::size_t>(greys->columns * greys->rows));
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&picture, &white, greys->levels.data(), 0, nullptr) == 0)
    return fmt::format("{}: {}", file, picture.message);
  return Picture{std::move(greys), sha256(bytes)};
}

}  // namespace vitrum::scene
