#pragma once
#include <filesystem>
#include <span>

#include "observe/table.hpp"

namespace vitrum::output {

/// Writes DIR/tables.h5 from the files NAME.csv of the tables as they stand: a group a table, a data set a
/// column. A column of texts holds indices into the data set NAME_names beside it. per_metre: what quantities
/// of the whole body are (plane strain). Throws FileError, also for a file that holds no such table.
void store_tables(const std::filesystem::path& directory, std::span<const TableInfo> tables, bool per_metre);

}  // namespace vitrum::output
