#pragma once
#include <string>
#include <vector>

namespace vitrum::app {

struct CheckOptions {
  std::string scene;
  std::vector<std::string> overrides;
  bool json = false;
};

/// `vitrum check`: validates, prints derived quantities, warnings and the resolved scene; runs nothing.
int check_scene(const CheckOptions& options);

}  // namespace vitrum::app
