#pragma once
#include <nvector/nvector_serial.h>

#include <cstddef>

#include "integrators/sundials/context.hpp"
#include "integrators/sundials/owned.hpp"

namespace vitrum::sundials {

using StateVector = Owned<N_Vector, N_VDestroy>;

/// SUNDIALS' serial vector, whose linear combinations and norms make one pass over memory with independent
/// sums (SUNDIALS' own make a pass for each term, and add one number at a time: a third of an explicit run).
/// Clones inherit this. Throws std::bad_alloc. Zero at first.
StateVector make_state_vector(std::size_t size, const Context& context);

}  // namespace vitrum::sundials
