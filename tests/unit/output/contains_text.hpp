#pragma once
#include <string>

#include "tests/catch.hpp"

namespace vitrum {

/// Matches strings that contain `text`, under the name that the installed Catch2 knows.
inline auto contains_text(const std::string& text) {
#if CATCH_VERSION_MAJOR >= 3
  return Catch::Matchers::ContainsSubstring(text);
#else
  return Catch::Matchers::Contains(text);
#endif
}

}  // namespace vitrum
