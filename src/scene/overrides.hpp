#pragma once
#include <toml++/toml.h>

#include <string_view>

#include "scene/diagnostics.hpp"

namespace vitrum::scene {

/// Applies `--set` argument `number` (counted from 1), `a.b.c=VALUE`, to a document. VALUE is any TOML value;
/// list items are named by index; missing keys and tables are created, missing list items are not, except
/// those of lists that have a default. Arguments apply in order: the later wins. Setting integrator.step
/// removes integrator.courant and the other way round, also between two --set arguments. Faults are added to
/// `diagnostics`, and the document is then left as it was.
void apply_override(toml::table& document, std::string_view text, std::size_t number,
                    Diagnostics& diagnostics);

}  // namespace vitrum::scene
