#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "example_texts.hpp"
#include "scene/read_scene.hpp"
#include "tests/catch.hpp"

namespace vitrum::test {

/// A change that makes a valid text invalid, and the message it must lead to.
struct Malformed {
  std::string_view from, to;  ///< the change to the valid text
  std::string_view start;     ///< how the message begins: place and key
  std::vector<std::string_view> parts;
};

/// The messages of the InputError that `parse` throws; none when it does not.
template <class Parse>
std::vector<std::string> faults(Parse&& parse) {
  try {
    parse();
  } catch (const InputError& error) {
    return error.messages();
  }
  return {};
}

template <class Parse>
void require_single_fault(const Malformed& input, std::string_view valid, Parse&& parse) {
  const std::string text = with(valid, input.from, input.to);
  const std::vector<std::string> messages = faults([&] { parse(text, "s.toml"); });
  INFO("'" << input.from << "' -> '" << input.to << "'");
  for (const std::string& message : messages) UNSCOPED_INFO(message);
  REQUIRE(messages.size() == 1);
  CHECK(messages[0].starts_with(input.start));
  CHECK(messages[0].find('\n') == std::string::npos);
  for (const std::string_view part : input.parts) {
    INFO("expected part: " << part);
    CHECK(messages[0].find(part) != std::string::npos);
  }
}

inline void require_scene_faults(const std::vector<Malformed>& inputs) {
  for (const Malformed& input : inputs)
    require_single_fault(input, scene_text, [](auto text, auto name) { parse_scene(text, name); });
}

}  // namespace vitrum::test
