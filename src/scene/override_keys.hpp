#pragma once
#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "scene/override_text.hpp"

namespace vitrum::scene {

/// The first `count` keys as a path.
std::string joined(const std::vector<std::string>& keys, std::size_t count);

/// Whether a key is a number.
bool is_index(std::string_view key);

/// The item of `list` that `keys[depth]` names. Throws Refusal where there is none.
std::size_t item_index(const toml::array& list, const std::vector<std::string>& keys, std::size_t depth);

/// The keys with indices in place of names, as far as the document goes. Throws Refusal for a name that no
/// item has, or several.
std::vector<std::string> with_indices(const toml::table& document, const std::vector<KeyPart>& parts);

}  // namespace vitrum::scene
