#pragma once
#include <array>

#include "mpm/system.hpp"

/// From sums to velocities, block by block, for passes that go on with a block's nodes as soon as these are
/// summed (Nodes::moved, transfer.hpp). momentum, force: of its nodes only.
namespace vitrum::mpm {

using BlockVector = std::array<const double*, 2>;

/// The components of a nodal vector, of a block's nodes. component_0: the first; the other follows.
BlockVector block_vector(const Grid& grid, std::size_t block, Field component_0);

/// after: held components get the velocities of the step's end.
void project_block(Grid& grid, std::size_t block, const BlockVector& momentum, bool after = false);
void accelerate_block(Grid& grid, std::size_t block, const BlockVector& force,
                      const std::array<double, 2>& gravity, double duration);
/// Work (J per radian or metre, over a second) of gravity on a block's nodes and of the reaction m a - f - m
/// g that keeps a node at its prescribed velocity, at the mean of two nodal velocities; of the acceleration,
/// which is the particles', at theirs: they need not have the velocity of the node, and where a wall has
/// started with a jump they have not. Held (zero-velocity) nodes and the axis do no work.
double external_power(const System& system, std::size_t block, const BlockVector& force, Field from,
                      Field to);

}  // namespace vitrum::mpm
