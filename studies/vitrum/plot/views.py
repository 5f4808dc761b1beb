"""What part of the plane a picture shows. Lengths in metres."""
from dataclasses import dataclass

import numpy as np


@dataclass
class View:
    """Limits of the axes."""
    left: float
    right: float
    bottom: float
    top: float

    @property
    def width(self):
        return self.right - self.left

    @property
    def height(self):
        return self.top - self.bottom


def bulk(values):
    """The range of all `values` but the few outermost: debris far away must not set the scale."""
    return np.quantile(values, [0.01, 0.99])


def focus_body(run):
    """The body that a picture is about: the one with most particles among those that can be damaged."""
    damage = run.frames[-1].field("damage")
    candidates = np.isfinite(damage) if damage is not None else np.ones(len(run.body), bool)
    return int(np.argmax(np.bincount(run.body[candidates], minlength=len(run.bodies))))


def is_slender(run):
    """Whether the focus body is too flat to be seen whole at equal scales."""
    start = run.frames[0].position[run.body == focus_body(run)]
    size = np.ptp(start, axis=0) + run.cell
    return size[0] * (2 if run.axisymmetric else 1) > 8.0 * size[1]


def whole(run, frames, shown):
    """The bulk of the particles of `shown` (a mask) in all `frames`, at equal scales."""
    focus = shown & (run.body == focus_body(run))
    low, high = _joint([bulk(frame.position[focus, 0]) for frame in frames])
    reach = high - low
    others = _joint([bulk(frame.position[shown, 0]) for frame in frames])
    low, high = max(others[0], low - reach), min(others[1], high + reach)
    left = -high if run.axisymmetric else low
    places = _joint([bulk(frame.position[focus, 1]) for frame in frames])
    return _padded(run, left, high, *_heights(run, frames, shown, (left, high), places))


def close_up(run, frames, shown):
    """The middle of a slender body as far out as it breaks, but no more than three tenths of it; at equal scales."""
    low, high = _extent(run, 0)
    bottom, top = _extent(run, 1)
    middle = 0.0 if run.axisymmetric else 0.5 * (low + high)
    broken = frames[-1].separated() & (run.body == focus_body(run))
    distance = np.abs(frames[-1].position[broken, 0] - middle)
    reach = min(0.3 * (high - middle), max(12.0 * (top - bottom), 1.5 * bulk(distance)[1] if distance.size else 0.0))
    sides = middle - reach, middle + reach
    return _padded(run, *sides, *_heights(run, frames, shown, sides, (bottom, top)))


def broken(run, frames):
    """Where particles have localised or separated in any of the frames, at equal scales; None: nowhere."""
    places = []
    for frame in frames:
        plane = frame.plane()
        failed = frame.separated() if plane is None else frame.separated() | plane[0]
        if np.any(failed):
            places.append([bulk(frame.position[failed, axis]) for axis in (0, 1)])
    if not places:
        return None
    margin = 4.0 * run.cell
    (left, right), (bottom, top) = (_joint([place[axis] for place in places]) for axis in (0, 1))
    if run.axisymmetric:
        left = -right
    # No flatter than three to one, so that titles and scales stand beside something.
    height = max(top - bottom + 2.0 * margin, (right - left + 2.0 * margin) / 3.0)
    middle = 0.5 * (bottom + top)
    return View(left - margin, right + margin, middle - 0.5 * height, middle + 0.5 * height)


def strip(run):
    """The whole length of the focus body, and its thickness above and below its first place."""
    low, high = _extent(run, 0)
    bottom, top = _extent(run, 1)
    margin = 0.02 * (high - low)
    thickness = top - bottom
    return View((-high if run.axisymmetric else low) - margin, high + margin, bottom - thickness, top + thickness)


def _extent(run, axis):
    """Both ends of the focus body at the first output."""
    focus = run.body == focus_body(run)
    position, half = run.frames[0].position[focus, axis], 0.5 * run.side[focus]
    return np.min(position - half), np.max(position + half)


def _joint(ranges):
    return min(low for low, _ in ranges), max(high for _, high in ranges)


def _heights(run, frames, shown, sides, focus):
    """Vertical range of the bulk of every shown body between both sides; where that is far from the range `focus`, no
    farther than six tenths of the width."""
    lowest, highest = focus[0] - 0.6 * (sides[1] - sides[0]), focus[1] + 0.6 * (sides[1] - sides[0])
    near = [focus]
    for body in range(len(run.bodies)):
        chosen = shown & (run.body == body)
        for frame in frames:
            inside = (frame.position[:, 0] >= sides[0]) & (frame.position[:, 0] <= sides[1])
            if np.any(chosen & inside):
                near.append(bulk(frame.position[chosen & inside, 1]))
    low, high = _joint([(low, high) for low, high in near if low < highest and high > lowest])
    return max(low, lowest), min(high, highest)


def _padded(run, left, right, bottom, top):
    margin = max(run.cell, 0.02 * max(right - left, top - bottom))
    return View(left - margin, right + margin, bottom - margin, top + margin)
