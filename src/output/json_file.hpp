#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

namespace vitrum::output {

/// The JSON object in a file; nothing when there is no such file. Throws FileError for anything else than an
/// object, and for what no run writes: more than 64 MB, or values nested deeper than 32 (which would overflow
/// the stack of those who walk through them).
std::optional<nlohmann::ordered_json> read_json_object(const std::filesystem::path& path);

}  // namespace vitrum::output
