#pragma once
#include <vector>

#include "mpm/system.hpp"
#include "observe/failure_report.hpp"

namespace vitrum {

/// Whether particles of a body can separate: its material stores `decohesion`, which is 1 from then on.
bool separates(const Body& body);

/// A connected set of unseparated particles of one body.
struct ConnectedPiece {
  std::size_t body;
  std::vector<std::size_t> particles;
};

/// Connected components of the unseparated particles of one body, whose material can separate.
std::vector<ConnectedPiece> pieces_of(const System& system, std::size_t body);

/// Those of every body whose material can separate, joining
/// particles of a body within 1.5 cells; by falling number of particles. Separated particles belong to no
/// piece: they are where the cracks run.
std::vector<ConnectedPiece> connected_pieces(const System& system);

/// For each body, in storage order: the number of the piece to which a particle belongs, 0 for the first; -1
/// for separated particles; NaN where the material cannot separate. No columns where none can.
std::vector<std::vector<double>> piece_numbers(const System& system);

/// Mass, centre and velocity of the pieces, by falling mass.
std::vector<Fragment> fragments(const System& system, const std::vector<ConnectedPiece>& pieces);

}  // namespace vitrum
