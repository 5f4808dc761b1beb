"""Outputs packed for the page: positions in 16 bits of the drawn extent, fields in 8 bits of their scale."""
from __future__ import annotations

import base64
from dataclasses import dataclass
from typing import Any, Callable

import numpy as np

from vitrum.plot import looks, views
from vitrum.results import Frame, Run

most_frames = 60
budget = 1_000_000  # particles times frames; some 12 bytes each
nothing = 255  # a particle without a value


@dataclass(frozen=True)
class Shown:
    """A field of the page: `values(frame)` gives N numbers (NaN: none); `kind` says how they become colours: "class" by number, "scale" from least to
    most of the run, "log" by decades."""
    key: str
    label: str
    kind: str
    values: Callable[[Frame], np.ndarray | None]
    factor: float = 1.0


def _state(frame: Frame) -> np.ndarray:
    return frame.separated().astype(float)


def _speed(frame: Frame) -> np.ndarray | None:
    velocity = frame.field("velocity")
    return None if velocity is None else np.linalg.norm(velocity, axis=1)


def _piece_colours(run: Run) -> Callable[[Frame], np.ndarray | None]:
    """0: the piece of most particles in its body; 1 to 6: others, in turn; 7: a separated particle."""
    def classes(frame: Frame) -> np.ndarray | None:
        piece = frame.piece()
        if piece is None or np.all(np.isnan(piece)):
            return None
        found = np.where(piece < 0, 7.0, 1.0 + np.mod(piece, 6))
        for body in range(len(run.bodies)):
            of = (run.body == body) & (piece >= 0)
            if np.any(of):
                numbers, counts = np.unique(piece[of], return_counts=True)
                found[of & (piece == numbers[np.argmax(counts)])] = 0.0
        found[np.isnan(piece)] = 0.0
        return found
    return classes


def _fields(run: Run) -> list[Shown]:
    return [Shown("bodies", "bodies, separated", "class", _state), Shown("pieces", "fragments", "class", _piece_colours(run)),
            Shown("damage", "damage D", "scale", lambda frame: frame.field("damage")),
            Shown("opening", "opening, µm", "log", lambda frame: frame.opening(), 1e6), Shown("speed", "speed, m/s", "scale", _speed)]


def _packed(shown: Shown, frames: list[Frame], chosen: slice) -> dict[str, Any] | None:
    """None where no particle of any frame has a value, or none but zero."""
    rows = [shown.values(frame) for frame in frames]
    if any(row is None for row in rows):
        return None
    values = shown.factor * np.array(rows)[:, chosen]
    if shown.kind == "class":
        codes, low, high = np.where(np.isnan(values), nothing, values), 0.0, 0.0
    else:
        finite = values[np.isfinite(values)]
        high = float(finite.max(initial=0.0))
        if high <= 0.0:
            return None
        # Three decades below the most; of a field that is not logarithmic, from nothing.
        low = 1e-3 * high if shown.kind == "log" else 0.0
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.log(values / low) / np.log(high / low) if shown.kind == "log" else values / high
        codes = np.where(np.isnan(values), nothing, np.rint(254.0 * np.clip(np.nan_to_num(share, neginf=0.0), 0.0, 1.0)))
    return {"key": shown.key, "label": shown.label, "kind": shown.kind, "low": low, "high": high, "data": _text(codes.astype(np.uint8))}


def _text(array: np.ndarray) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()


def spread(run: Run) -> list[Frame]:
    """Outputs of the page: all, or so many spread over the run."""
    count = len(run.frames)
    most = max(12, min(most_frames, budget // max(1, len(run.mass))))
    return [run.frames[n] for n in (range(count) if count <= most else np.unique(np.linspace(0, count - 1, most).astype(int)))]


def packed(run: Run) -> dict[str, Any] | None:
    """All that the page's player needs; None for a run without particles."""
    if not run.frames:
        return None
    frames = spread(run)
    stride = max(1, -(-len(frames) * len(run.mass) // budget))
    chosen = slice(None, None, stride)
    everything = np.ones(len(run.mass), bool)
    close = views.is_slender(run)
    whole = views.whole(run, frames, everything)
    view = views.close_up(run, frames, everything) if close else whole
    places = np.array([frame.position[chosen] for frame in frames])
    reach = max(whole.width, whole.height)
    # What has flown farther than the view's own size stands at the edge of that.
    low = np.array([whole.left - reach, whole.bottom - reach])
    size = np.array([whole.width + 2.0 * reach, whole.height + 2.0 * reach])
    share = np.clip(np.nan_to_num((places - low) / size, nan=0.0), 0.0, 1.0)
    fields = [found for shown in _fields(run) if (found := _packed(shown, frames, chosen)) is not None]
    return {"count": int(places.shape[1]), "stride": stride, "times": [frame.time for frame in frames], "mirror": run.axisymmetric,
            "low": low.tolist(), "size": size.tolist(), "views": [_limits(each) for each in ([view, whole] if close else [view])],
            "body": _text(run.body[chosen].astype(np.uint8)), "side": (run.side[chosen] * np.sqrt(stride)).tolist() if stride > 1 or np.ptp(run.side) > 0 else float(run.side[0]),
            "places": _text(np.rint(65535.0 * share).astype("<u2")), "fields": fields, "bodies": run.bodies,
            "looks": [list(looks.body_look(body, separated) for separated in (False, True)) for body in range(len(run.bodies))],
            "pieces": looks.piece_colours, "of": len(run.frames)}


def _limits(view: views.View) -> list[float]:
    return [view.left, view.right, view.bottom, view.top]
