"""Connected pieces, as the summary counts them: particles of one body that have not separated, no farther apart than 1.5 cells."""
from typing import Any

import numpy as np

reach_in_cells = 1.5


def _neighbours(position, reach):
    """Pairs (n x 2) of points no farther apart than `reach`, by bins of that size."""
    bins: dict[Any, list[int]] = {}
    for point, place in enumerate(map(tuple, np.floor(position / reach).astype(np.int64))):
        bins.setdefault(place, []).append(point)
    pairs = []
    for (column, row), here in bins.items():
        for step in ((0, 0), (1, -1), (1, 0), (1, 1), (0, 1)):
            there = bins.get((column + step[0], row + step[1]))
            if there is None:
                continue
            first, second = (each.ravel() for each in np.meshgrid(here, there, indexing="ij"))
            near = (np.linalg.norm(position[first] - position[second], axis=1) <= reach) & (first != second)
            pairs.append(np.column_stack([first[near], second[near]]))
    return np.concatenate(pairs) if pairs else np.empty((0, 2), int)


def _labels(count, pairs):
    """A number for each of `count` points, the same for those that pairs connect: the lowest of them spreads until nothing changes."""
    label = np.arange(count)
    while len(pairs):
        before = label.copy()
        low = np.minimum(label[pairs[:, 0]], label[pairs[:, 1]])
        np.minimum.at(label, pairs[:, 0], low)
        np.minimum.at(label, pairs[:, 1], low)
        label = label[label]
        if np.array_equal(before, label):
            break
    return label


def pieces(run, frame):
    """Piece of each particle (N): -1 for one that has separated; within a body, and over all, heaviest first."""
    found = np.full(len(run.body), -1)
    whole = ~frame.separated() & np.all(np.isfinite(frame.position), axis=1)
    offset = 0
    for body in range(len(run.bodies)):
        chosen = np.flatnonzero(whole & (run.body == body))
        if not chosen.size:
            continue
        position = frame.position[chosen]
        found[chosen] = offset + _labels(len(chosen), _neighbours(position, reach_in_cells * run.cell))
        offset += len(chosen)
    used = np.unique(found[found >= 0])
    masses = np.array([run.mass[found == piece].sum() for piece in used])
    rank = {piece: n for n, piece in enumerate(used[np.argsort(-masses, kind="stable")])}
    return np.array([rank.get(piece, -1) for piece in found])


def piece_masses(run, frame):
    """Body -> masses of its pieces, heaviest first."""
    found = pieces(run, frame)
    return {body: sorted((float(run.mass[(found == piece) & (run.body == body)].sum()) for piece in np.unique(found[(run.body == body) & (found >= 0)])),
                         reverse=True) for body in range(len(run.bodies))}
