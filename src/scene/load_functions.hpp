#pragma once
#include <memory>

#include "mpm/load_function.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// The function in place of the number at a dotted path; null: there is none. A formula throws
/// ComputationError from `at`, naming the key, where it is no finite number.
std::shared_ptr<const mpm::LoadFunction> load_function(const Scene& scene, const std::string& path);

/// The same where a constant may stand: a number or, where the path has one, its function.
std::shared_ptr<const mpm::LoadFunction> load_function(const Scene& scene, const std::string& path,
                                                       double number);

}  // namespace vitrum
