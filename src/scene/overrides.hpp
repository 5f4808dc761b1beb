#pragma once
#include <toml++/toml.h>

#include <string_view>

#include "scene/diagnostics.hpp"

namespace vitrum::scene {

/// Applies `--set` argument `number` (counted from 1), `a.b.c=VALUE`, to a document. VALUE is any TOML value,
/// or none, which takes the key, table or list item away. List items are named by index, or by the `name`
/// that they have: one that is a number in quotes. Missing keys and tables are created, missing list items
/// are not, except those of lists that have a default. Arguments apply in order: the later wins. Setting
/// integrator.step removes integrator.courant and the other way round, also between two --set arguments.
/// Faults are added to `diagnostics`, and the document is then left as it was.
void apply_override(toml::table& document, std::string_view text, std::size_t number,
                    Diagnostics& diagnostics);

}  // namespace vitrum::scene
