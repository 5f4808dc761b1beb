#pragma once
#include "scene/table_view.hpp"

namespace vitrum::scene {

/// Reads a table, and the tables in it, into the struct that its rows are of. Keys that are unknown, missing
/// or exclude each other, and values of the wrong type or out of bounds are reported; members whose keys are
/// absent or faulty keep their defaults. Integers are taken where numbers are expected, not the other way
/// round.
void read_table(const TableView& table, void* owner);

}  // namespace vitrum::scene
