#pragma once
#include <nvector/nvector_serial.h>

#include <cstddef>

#include "integrators/sundials/ark_system.hpp"
#include "integrators/sundials/context.hpp"
#include "integrators/sundials/owned.hpp"

namespace vitrum::sundials {

using StateVector = Owned<N_Vector, N_VDestroy>;

/// SUNDIALS' serial vector for the unknowns of a system. Sums, copies, fillings and norms, which are most of
/// what ARKODE does with vectors, go over the system's parts, on its threads; norms are the same for any
/// number of threads. Linear combinations make one pass over memory (SUNDIALS' own make one for each term).
/// Clones inherit this. system must outlive all of them. One thread works with all
/// vectors of a system, the one that made them. Throws std::bad_alloc. Zero at first.
StateVector make_state_vector(const ArkSystem& system, const Context& context);

}  // namespace vitrum::sundials
