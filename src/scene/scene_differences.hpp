#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace vitrum {

/// What two resolved scenes (write_scene.hpp) differ in, one text a key: "key 'time.end': found 2e-4,
/// expected 1e-4".
std::vector<std::string> scene_differences(std::string_view found, std::string_view expected);

}  // namespace vitrum
