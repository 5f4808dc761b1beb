#pragma once
#include <map>
#include <string>

#include "schema/table.hpp"

namespace vitrum::scene {

/// A value as TOML; read back it is the same, numbers bit for bit.
std::string value_text(const schema::Value& value);

/// A struct as TOML, every default filled in: read_table reads it back as the same. Keys whose absence means
/// something stay absent.
/// `formulas`, by the path of their key, stand behind their values as comments; `functions` in place of
/// theirs.
std::string table_text(const schema::Table& table, const void* owner,
                       const schema::PlacedTexts& formulas = {}, const schema::Functions& functions = {});

}  // namespace vitrum::scene
