#include "scene/input_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

#include "scene/input_error.hpp"

namespace vitrum {
namespace {

/// Bytes. Also what ends the reading of devices that never end.
constexpr std::size_t largest_file = std::size_t{16} << 20;

void require_file(const std::string& name, std::string_view expected) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(name, error);
  // A name that leads nowhere is the user's mistake; everything else that goes wrong is the file system's.
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError(fmt::format("{}: found no such file, expected {}", name, expected));
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{}: found a directory, expected {}", name, expected));
}

std::string read_all(std::istream& stream, const std::string& name, std::string_view expected) {
  std::string text;
  std::array<char, 16384> piece{};
  do {
    stream.read(piece.data(), piece.size());
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
  } while (stream && text.size() <= largest_file);
  if (text.size() > largest_file)
    throw InputError(
        fmt::format("{}: found more than {} MB, expected {}", name, largest_file >> 20, expected));
  return text;
}

}  // namespace

InputText read_input(const std::string& file) {
  constexpr std::string_view expected = "a TOML file";
  if (file == "-") return {"<stdin>", read_all(std::cin, "<stdin>", expected)};
  return {file, read_file(file, expected)};
}

std::string read_file(const std::string& file, std::string_view expected) {
  require_file(file, expected);
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text = read_all(stream, file, expected);
  if (!stream.is_open() || stream.bad())
    throw FileError(fmt::format("{}: cannot be read: {}", file, std::generic_category().message(errno)));
  return text;
}

}  // namespace vitrum
