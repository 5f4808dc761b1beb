"""Flops and bytes of one particle-step, counted from the source: explicit MUSL, linear shape functions, axisymmetric, elastic.

An addition, a product and a quotient are a flop each; products with 1 and -1, comparisons and conversions are none. What the vector of a
node carries along without need is not counted. Bytes are those of a scene that no cache holds, but whose strips of blocks one does: every
column comes from memory once a step and, if it is changed, goes back once.
"""

# src/mpm/stencil.hpp, in each of three passes: x / h, s, 1 - s, for two axes.
stencil = 3 * 2 * 3
# src/mpm/scatter.cpp: Hooke's law; what a particle gives (momenta, four stresses times volume, hoop), and per node N, mass, two momenta,
# forces.
scatter = 10 + 10 + 4 * (1 + 2 + 2 * 2 + 2 + 2 * 4)
# src/mpm/gather.cpp, velocity_and_rescatter: per node N and two changes; velocities, kinetic energy; momenta back to the nodes.
gather_velocity = 4 * (1 + 2 * 2) + 2 + 6 + 2 + 4 * (1 + 2 * 2)
# strain_and_position: per node N, hoop and motion, four derivatives; spin, hoop; the turn's series; rotation; new position.
series, rotation = 18, 19
gather_strain = 4 * (1 + 3 * 2 + 4 * 2) + 2 + 2 + 5 + 1 + series + rotation + 4
# materials/composite_batch.hpp, take_elastic: strain, turn, rotation, energy.
elastic = 4 + series + rotation + 19
# src/mpm/nodes.cpp and the sums of tiles, per node; shared by the particles of a cell.
nodes = 30

double = 8
read = 2 + 2 + 1 + 4  # position, velocity, mass, elastic strain
changed = read - 1  # all but the mass


def flops(particles_per_cell):
    return stencil + scatter + gather_velocity + gather_strain + elastic + nodes / particles_per_cell


def bytes_moved():
    return (read + changed) * double
