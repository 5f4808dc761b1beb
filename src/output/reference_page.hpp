#pragma once
#include <string>

namespace vitrum::output {

/// The Markdown page docs/reference/result.md. Its table of state variables comes from all_columns().
std::string result_reference();

}  // namespace vitrum::output
