#pragma once
#include <toml++/toml.h>

#include <optional>

#include "scene/table_view.hpp"

namespace vitrum::scene {

/// The value that a node gives to a key of a table, formulas evaluated. Nothing: it is none that the key
/// could have, and the table's diagnostics say why.
std::optional<schema::Value> read_value(const TableView& table, const schema::Key& key,
                                        const toml::node& node);

}  // namespace vitrum::scene
