#include "output/json_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "output/regular_file.hpp"
#include "scene/input_error.hpp"

namespace vitrum::output {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t largest_file = std::uintmax_t{64} << 20;
constexpr int deepest = 32;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw FileError(fmt::format("{}: is not a summary of a run: {}", path.string(), why));
}

}  // namespace

std::optional<Json> read_json_object(const std::filesystem::path& path) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure) && !failure) return std::nullopt;
  require_regular_file(path);
  if (std::filesystem::file_size(path, failure) > largest_file) refuse(path, "it is too large");
  std::ifstream file(path);
  if (!file) throw FileError(fmt::format("{}: cannot be read", path.string()));
  const auto bounded = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest) refuse(path, "it is nested too deeply");
    return true;
  };
  try {
    Json json = Json::parse(file, bounded);
    if (!json.is_object()) refuse(path, "it is not a JSON object");
    return json;
  } catch (const Json::parse_error& error) {
    refuse(path, fmt::format("it is not JSON from byte {} on", error.byte));
  } catch (const Json::out_of_range& error) {
    refuse(path, error.what());
  }
}

}  // namespace vitrum::output
