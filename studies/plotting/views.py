"""What part of the plane a picture shows. Lengths in metres unless a name says mm."""
from dataclasses import dataclass

import numpy as np


@dataclass
class View:
    """Limits of the axes; `exaggeration` is how much the vertical axis is stretched."""
    left: float
    right: float
    bottom: float
    top: float
    exaggeration: float = 1.0

    @property
    def width(self):
        return self.right - self.left

    @property
    def height(self):
        return self.top - self.bottom


def bulk(values, part=0.99):
    """The range of all `values` but the few outermost: debris far away must not set the scale."""
    values = values[np.isfinite(values)]
    return np.quantile(values, [(1.0 - part) / 2.0, (1.0 + part) / 2.0])


def focus_body(run):
    """The body that a picture is about: the one with most particles among those that can be damaged."""
    damage = run.frames[-1].field("damage")
    candidates = np.isfinite(damage) if damage is not None else np.ones(len(run.body), bool)
    return int(np.argmax(np.bincount(run.body[candidates], minlength=len(run.bodies))))


def whole(run, frames, shown):
    """All particles of `shown` (a mask), but for debris; mirrored about the axis."""
    x = np.concatenate([frame.position[shown, 0] for frame in frames])
    low, high = bulk(x)
    return _padded(run, -high if run.axisymmetric else low, high, *_heights(run, frames, shown, low, high))


def is_slender(run):
    """Whether the focus body is too flat to be seen whole at equal scales."""
    start = run.frames[0].position[run.body == focus_body(run)]
    size = np.ptp(start, axis=0) + run.cell
    return size[0] * (2 if run.axisymmetric else 1) > 8.0 * size[1]


def close_up(run, frames, shown):
    """The middle of a slender body, as far out as it breaks, at equal scales."""
    focus = run.body == focus_body(run)
    low, high = bulk(run.frames[0].position[focus, 0], 1.0)
    middle = 0.0 if run.axisymmetric else 0.5 * (low + high)
    reach = 0.3 * (high - middle)
    broken = focus & frames[-1].separated()
    if np.any(broken):
        distance = np.abs(frames[-1].position[broken, 0] - middle)
        reach = np.clip(1.5 * np.quantile(distance, 0.98), 0.1 * (high - middle), reach)
    return _padded(run, middle - reach, middle + reach, *_heights(run, frames, shown, middle - reach, middle + reach))


def strip(run, frames, shown, exaggeration):
    """The whole length of the focus body, stretched vertically; only what stays near its first place."""
    focus = shown & (run.body == focus_body(run))
    view = whole(run, frames, focus)
    thickness = np.ptp(run.frames[0].position[focus, 1]) + run.cell
    first = bulk(run.frames[0].position[focus, 1], 1.0)
    view.bottom, view.top = first[0] - thickness, first[1] + thickness
    view.exaggeration = exaggeration
    return view


def _heights(run, frames, shown, left, right):
    """Vertical range of the bulk of `shown` between left and right; no farther from the focus body than the view is wide."""
    focus = run.body == focus_body(run)
    all_z, focus_z = [], []
    for frame in frames:
        inside = (frame.position[:, 0] >= left) & (frame.position[:, 0] <= right)
        all_z.append(frame.position[shown & inside, 1])
        focus_z.append(frame.position[focus & inside, 1])
    low, high = bulk(np.concatenate(all_z))
    focus_low, focus_high = bulk(np.concatenate(focus_z))
    return max(low, focus_low - (right - left)), min(high, focus_high + (right - left))


def _padded(run, left, right, bottom, top):
    margin = max(2.0 * run.cell, 0.03 * max(right - left, top - bottom))
    return View(left - margin, right + margin, bottom - margin, top + margin)
