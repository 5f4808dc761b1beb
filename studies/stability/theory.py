"""Von Neumann and Floquet analysis of the explicit schemes on an endless row of cells.

Units: cell, wave speed and density are 1. Particles of one cell sit at `places`; a wave e^(ik cell) has the amplitudes V (velocities) and S
(stresses) of these particles. With P the projection onto the nodes, F the force of stresses, D the gradient and G the gather:
USF: S += dt D P V, then V += dt G F S.  USL: the nodes first, v = P V + dt F S, then S += dt D v, V += dt G F S.
MUSL: V first, then S += dt D P V with the new V. The row is stable when no eigenvalue of a step exceeds 1 for any k; for a row that travels,
of the product of the steps over whole cells.
"""
import numpy as np

waves = np.linspace(0.0, np.pi, 61)[1:]


def _hat(t):
    return max(0.0, 1.0 - abs(t))


def _area(t):
    """Integral of the hat from -1 to t."""
    t = min(max(t, -1.0), 1.0)
    return 0.5 * (1.0 + t) ** 2 if t < 0.0 else 0.5 + t - 0.5 * t * t


def weights(shape, x, half):
    """Nodes, values and slopes of a particle at x (cells) whose side is 2 `half`."""
    if shape == "linear":
        first = np.floor(x)
        s = x - first
        return first + np.arange(2), np.array([1.0 - s, s]), np.array([-1.0, 1.0])
    if shape == "bspline2":
        first = np.floor(x - 0.5)
        s = x - first - 1.0
        return first + np.arange(3), np.array([0.5 * (0.5 - s) ** 2, 0.75 - s * s, 0.5 * (0.5 + s) ** 2]), np.array([s - 0.5, -2.0 * s, s + 0.5])
    first = np.floor(x - half)
    nodes = first + np.arange(3)
    low, high = x - half - nodes, x + half - nodes
    width = 0.5 / half
    return (nodes, width * np.array([_area(b) - _area(a) for a, b in zip(low, high)]),
            width * np.array([_hat(b) - _hat(a) for a, b in zip(low, high)]))


def step_matrices(scheme, shape, places, dt):
    """One step for every wave: waves x 2n x 2n, unknowns V then S."""
    n = len(places)
    half = 0.5 / n
    project, force, gather, gradient = (np.empty((len(waves), n), complex) for _ in range(4))
    for j, x in enumerate(places):
        nodes, value, slope = weights(shape, x, half)
        phase = np.exp(1j * np.outer(waves, nodes))
        project[:, j], force[:, j] = phase.conj() @ value / n, -(phase.conj() @ slope) / n
        gather[:, j], gradient[:, j] = phase @ value, phase @ slope
    identity = np.broadcast_to(np.eye(n), (len(waves), n, n))
    zero = np.zeros_like(identity)
    strain = dt * gradient[:, :, None] * project[:, None, :]
    push = dt * gather[:, :, None] * force[:, None, :]

    def blocks(vv, vs, sv, ss):
        return np.concatenate([np.concatenate([vv, vs], 2), np.concatenate([sv, ss], 2)], 1)

    accelerate = blocks(identity, push, zero, identity)
    stress = blocks(identity, zero, strain, identity)
    if scheme == "usf":
        return accelerate @ stress
    if scheme == "musl":
        return stress @ accelerate
    return blocks(identity, push, strain, identity + dt * dt * gradient[:, :, None] * force[:, None, :])


def radius(matrices):
    """Largest modulus of an eigenvalue over all waves; inf when a product has overflown."""
    return float(np.abs(np.linalg.eigvals(matrices)).max()) if np.all(np.isfinite(matrices)) else np.inf


def places(per_side, offset):
    """Particles of a cell when the row's first cell begins at `offset` - 1/2 of a particle's side: one at `offset` for one per cell."""
    return [(j + offset) / per_side for j in range(per_side)]


def resting_limit(scheme, shape, per_side, offset):
    """Largest stable dt of a row at rest, in cells over wave speed."""
    def stable(dt):
        return radius(step_matrices(scheme, shape, places(per_side, offset), dt)) < 1.0 + 1e-4

    high = 0.02
    while stable(high) and high < 16.0:
        high *= 1.1
    low = high / 1.1
    for _ in range(20):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return low


def growth_per_cell(scheme, shape, per_side, speed, dt, phases=4):
    """Amplitude's growth while the row travels by one cell, `speed` over wave speed. Where in a step a particle passes a node
    matters: the largest over some phases."""
    return max(_growth(scheme, shape, per_side, speed, dt, 0.5 + speed * dt * n / phases) for n in range(phases))


def _growth(scheme, shape, per_side, speed, dt, offset, cells=4):
    count = max(1, round(cells / (speed * dt)))
    product = np.broadcast_to(np.eye(2 * per_side), (len(waves), 2 * per_side, 2 * per_side)).astype(complex)
    scale = 0.0
    for n in range(count):
        product = step_matrices(scheme, shape, [x + n * speed * dt for x in places(per_side, offset)], dt) @ product
        if n % 16 == 15:
            size = np.abs(product).max()
            product, scale = product / size, scale + np.log(size)
    return float(np.exp((np.log(radius(product)) + scale) / (count * speed * dt)))
