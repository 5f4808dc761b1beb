#pragma once
#include <string>

#include "schema/table.hpp"

namespace vitrum::schema {

/// A JSON schema (draft 7) of a document that holds `table`, for editors: names, types, bounds, choices,
/// defaults and meanings of its keys. `title`: what the document is.
std::string json_schema(const Table& table, const std::string& title);

}  // namespace vitrum::schema
