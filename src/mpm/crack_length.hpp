#pragma once
#include "mpm/system.hpp"

namespace vitrum::mpm {

/// Effective lengths L_e (eq. 12) where n x n particles a cell, n > 1, localise. A law knows the plane's way
/// through a cell; a particle's own part of the cell has an n-th of it, times the number of rows, at most n,
/// that the crack has taken within the plane's way through a cell. Rows of a cell share its strain: together
/// they open a crack once, not once a row; a row that cracks alone opens it as well. Of particle p with
/// normal n_p, among the cracked q
///   L_e = h/n c min(n, 1 + sum_q max(0, 1 - |t.x_pq|/w) (n_p.n_q)^2),   |n_p.x_pq| < (n - 1/2) h/n c,
/// c = max(|n_r|, |n_z|), w = h/n (|n_r| + |n_z|) the particle's width along the plane, t.
/// To be called when system.record.events are known: lengths are found anew around those that have localised.
/// Openings change in proportion, so that strains, stresses and stored energy stay. Hoop planes keep h.
void share_cracks(System& system);

}  // namespace vitrum::mpm
