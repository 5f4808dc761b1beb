#pragma once
#include <array>

#include "mpm/system.hpp"

/// The parts of project_velocities and apply_forces (transfer.hpp) for one block, for passes that go on with
/// a block's nodes as soon as these are summed.
namespace vitrum::mpm {

void project_block(Grid& grid, std::size_t block);
void accelerate_block(Grid& grid, std::size_t block, const std::array<double, 2>& gravity, double duration);
/// Enters the work of gravity and of prescribed velocities in the record of the step, once all blocks are
/// done.
void book_external_work(System& system, double duration);

}  // namespace vitrum::mpm
