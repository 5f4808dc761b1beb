"""What a run says of the plate over time. Places are those before the impact: debris flies, its origin stays."""
from functools import cached_property

import numpy as np

ring_width = 5e-3  # m
damaged = 0.1  # D of the damage front, as in summary.json
touched = 0.001  # D of the front of any damage: the scale of the paper's contours is unknown
touch = 5e-3  # m: the cylinder's radius; what fails below it is the contact itself


class History:
    """Times in s, radii in m; arrays have a row for each output."""

    def __init__(self, outcome):
        self.outcome = outcome
        run = outcome.results
        plate = run.body == run.bodies.index("plate")
        self.time = np.array([frame.time for frame in run.frames])
        self.radius = run.frames[0].position[plate, 0]
        self.separated = np.array([frame.separated()[plate] for frame in run.frames])
        self.damage = np.array([np.nan_to_num(frame.field("damage"))[plate] for frame in run.frames])
        opening = [frame.opening() for frame in run.frames]
        self.opening = np.array([np.nan_to_num(values[plate]) if values is not None else np.zeros(plate.sum()) for values in opening])
        self.plate_radius = self.radius.max() + 0.5 * run.cell
        # A ring has failed severely when as many of its particles have separated as one crack through the thickness takes, a column: of five with cells of 1 mm, of ten
        # with 0.5 mm.
        self.severe_share = run.cell / ring_width - 1e-9

    @cached_property
    def edges(self):
        return np.arange(0.0, self.plate_radius + 0.5 * ring_width, ring_width)

    def _per_ring(self, values):
        """Mean of each ring: outputs x rings."""
        ring = np.minimum((self.radius / ring_width).astype(int), len(self.edges) - 2)
        count = np.bincount(ring, minlength=len(self.edges) - 1)
        return np.array([np.bincount(ring, row, minlength=len(count)) for row in values]) / count

    @cached_property
    def separated_share(self):
        return self._per_ring(self.separated)

    @cached_property
    def ring_opening(self):
        """Median over the separated particles of each ring (m): one that flew off does not rule."""
        ring = (self.radius / ring_width).astype(int)
        last = self.opening[-1]
        return np.array([np.median(last[inside]) if np.any(inside := (ring == n) & self.separated[-1]) else 0.0
                         for n in range(len(self.edges) - 1)])

    def index(self, time):
        """Of the output at `time`; None when the run did not come so far."""
        return int(np.argmin(np.abs(self.time - time))) if time <= self.time[-1] + 1e-9 else None

    def _rings(self, low, high):
        centre = 0.5 * (self.edges[1:] + self.edges[:-1])
        return (centre > low) & (centre < high)

    def count(self, time, low=touch, high=np.inf):
        """Separated particles between two radii; None beyond the run's end."""
        n = self.index(time)
        inside = (self.radius > low) & (self.radius < high)
        return None if n is None else int(self.separated[n, inside].sum())

    def first_severe(self, low, high):
        """Time of the first output at which a ring between both radii has failed severely, or None."""
        severe = np.any(self.separated_share[:, self._rings(low, high)] >= self.severe_share, axis=1)
        return float(self.time[np.argmax(severe)]) if severe.any() else None

    def outermost_severe(self, time):
        """Outer radius of the outermost severe ring; 0 when there is none, None beyond the run's end."""
        n = self.index(time)
        if n is None:
            return None
        severe = np.nonzero(self.separated_share[n] >= self.severe_share)[0]
        return float(self.edges[severe[-1] + 1]) if severe.size else 0.0

    def _front(self, share):
        return np.array([self.edges[reached[-1] + 1] if (reached := np.nonzero(row >= self.severe_share)[0]).size else 0.0
                         for row in share])

    @cached_property
    def damage_front(self):
        """Outer radius of the outermost ring of which as much as a column has D > 0.1, so far."""
        return np.maximum.accumulate(self._front(self._per_ring(self.damage > damaged)))

    @cached_property
    def first_damage_front(self):
        """The same of D > 0.001."""
        return np.maximum.accumulate(self._front(self._per_ring(self.damage > touched)))

    @cached_property
    def separation_front(self):
        return np.maximum.accumulate(self._front(self.separated_share))

    def front_speed(self, front, until):
        """Mean speed (m/s) from touch to `until`, or to the run's end."""
        n = self.index(min(until, self.time[-1]))
        return float(front[n] / self.time[n])

    @cached_property
    def first_decohesion(self):
        """Time (s) of the plate's first localisation, inside its step."""
        first = self.outcome.summary["bodies"]["plate"]["first_localisation"]
        return first["time"] if first else None

    @cached_property
    def largest_opening_radius(self):
        """Middle of the ring with the largest median opening at the end."""
        n = int(np.argmax(self.ring_opening))
        return 0.5 * float(self.edges[n] + self.edges[n + 1]) if self.ring_opening[n] > 0.0 else None

    def made_energy(self, time):
        """Energy that the numerics have made by the output at `time` (or the run's end), over the initial one."""
        account = self.outcome.results.columns("energy")
        n = int(np.searchsorted(account["time"], time + 1e-9, side="right")) - 1
        return float(-account["residual"][n] / (account["kinetic"][0] + account["elastic"][0]))
