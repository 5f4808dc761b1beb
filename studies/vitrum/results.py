"""What a run left in its folder: fields, series, events, histories, the scene, how it was made."""
from __future__ import annotations

import json
import os
import pathlib
import tomllib
from functools import cached_property
from typing import Any, Sequence

import numpy as np

from vitrum.errors import InputError
from vitrum.tables import Columns, frame, read_csv

of_the_run = ("energy", "events")  # tables; the others are histories


class Frame:
    """The particles at one output: `time` (s), and fields by name: `frame["velocity"]`. Fields are read when they are asked for."""

    def __init__(self, run: Run, key: str, time: float, names: tuple[str, ...]) -> None:
        self._run, self._key = run, key
        self.time, self.names = time, names
        self._read: dict[str, np.ndarray] = {}

    def __getitem__(self, name: str) -> np.ndarray:
        """N values, or N x components; NaN where the particle's material lacks the variable."""
        if name not in self.names:
            raise InputError(f"{self._run.directory}: no field {name!r} in the outputs; there are {', '.join(self.names)}")
        if name not in self._read:
            with self._run.open() as result:
                self._read[name] = result["steps"][self._key]["particles"][name][()]
        return self._read[name]

    @property
    def position(self) -> np.ndarray:
        """N x 2, m."""
        return self["position"]

    def field(self, name: str) -> np.ndarray | None:
        """As `frame[name]`; None: no particle has it."""
        values = self[name] if name in self.names else None
        return None if values is None or np.all(np.isnan(values)) else values

    def separated(self) -> np.ndarray:
        """Which particles have separated (N)."""
        decohesion = self.field("decohesion")
        if decohesion is None:
            return np.zeros(len(self.position), bool)
        return np.nan_to_num(decohesion) >= 1.0

    def piece(self) -> np.ndarray | None:
        """Number of the connected piece of each particle (N): -1 for one that has separated; NaN where the material cannot. None: not stored."""
        with self._run.open() as result:
            drawn = result["steps"][self._key].get("drawn")
            if drawn is None or any("fragment" not in drawn[str(body)] for body in range(len(self._run.bodies))):
                return None
            return np.concatenate([drawn[str(body)]["fragment"][()] for body in range(len(self._run.bodies))])

    def opening(self) -> np.ndarray | None:
        """Length of the opening vector (m), eq. 14; None: no decohesion."""
        normal, tangential = self.field("opening_n"), self.field("opening_t")
        return None if normal is None or tangential is None else np.hypot(normal, tangential)

    def plane(self) -> tuple[np.ndarray, np.ndarray] | None:
        """Which particles have localised (N), and the normals of their planes (N x 2; both components 0: across the hoop direction). None: not stored."""
        length, normal_r, normal_z = self.field("effective_length"), self.field("normal_r"), self.field("normal_z")
        if length is None or normal_r is None or normal_z is None:
            return None
        return np.nan_to_num(length) > 0.0, np.nan_to_num(np.column_stack([normal_r, normal_z]))


class Run:
    """A finished, interrupted, killed or running run. Row i of every field is the same particle: `body[i]` is the number of its body, `mass[i]` its
    mass (kg, per metre in plane strain), `side[i]` what its square measures at the start (m).

    >>> import vitrum
    >>> from vitrum.program import studies
    >>> blocks = vitrum.run(studies / "trade/impact.toml", {"time.end": 2e-6, "output.every": 1e-6})
    >>> len(blocks.bodies), blocks.units["velocity"]
    (2, 'm/s')
    >>> blocks.fields("velocity", blocks.bodies[1]).shape
    (3, 480, 2)
    >>> sorted(blocks.histories), [column for column in blocks.series][:2]
    (['bodies'], ['contact', 'crack_area'])
    >>> round(float(blocks.energy["kinetic"][0]), 9)  # J/m
    0.468
    """

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self.directory = pathlib.Path(directory)
        try:
            with self.open() as result:
                if result.attrs.get("format") != "vitrum result 3":
                    raise InputError(f"{self._door}: not a vitrum result of this version")
                self._read(result)
        except (OSError, KeyError) as error:
            raise InputError(f"{self._door}: cannot be read: {error}".replace("\n", " ")) from error

    @property
    def _door(self) -> pathlib.Path:
        return self.directory / "result.h5"

    def open(self) -> Any:
        """result.h5, to be closed by the caller."""
        import h5py
        if not self._door.is_file():
            raise InputError(f"{self._door}: no such file; expected the folder of a run")
        return h5py.File(self._door)

    def _read(self, result: Any) -> None:
        self.title = str(result.attrs["title"])
        self.provenance = {name: str(value) for name, value in result["provenance"].attrs.items() if not name.startswith(".")}
        self.verbatim, self.resolved = (result["scene"][name][()].decode() for name in ("verbatim", "resolved"))
        self.scene: dict[str, Any] = tomllib.loads(self.resolved)
        self.axisymmetric = self.scene["space"]["geometry"] == "axisymmetric"
        self.cell = float(self.scene["space"]["cell"])
        self.bodies = [body["name"] for body in self.scene["body"]]
        self.materials = [body["material"] for body in self.scene["body"]]
        series = result["series"] if "series" in result else {}
        self._series: Columns = {name: values[()] for name, values in series.items()}
        self.units = {name: str(values.attrs["unit"]) for name, values in series.items()}
        steps = [(key, step) for key, step in (result["steps"].items() if "steps" in result else ()) if "particles" in step]
        self.frames = [Frame(self, key, float(step.attrs["time"]), tuple(step["particles"])) for key, step in steps]
        if steps:
            self.units |= {name: str(values.attrs["unit"]) for name, values in steps[0][1]["particles"].items()}
            self.body, self.mass, self.side = (result["particles"][name][()] for name in ("body", "mass", "size"))

    @property
    def time(self) -> np.ndarray:
        """Of the outputs with particles, s."""
        return np.array([each.time for each in self.frames])

    def fields(self, name: str, body: str | None = None) -> np.ndarray:
        """A field at every output: outputs x N, or outputs x N x components; of one body where it is named."""
        if body is not None and body not in self.bodies:
            raise InputError(f"{self.directory}: no body {body!r}; there are {', '.join(self.bodies)}")
        if not self.frames:
            raise InputError(f"{self.directory}: the run was made with --no-fields")
        chosen = slice(None) if body is None else self.body == self.bodies.index(body)
        return np.array([each[name][chosen] for each in self.frames])

    @cached_property
    def summary(self) -> dict[str, Any] | None:
        """summary.json; None while the run is under way, or when it was killed."""
        path = self.directory / "summary.json"
        try:
            return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None
        except ValueError as error:
            raise InputError(f"{path}: not JSON: {error}") from error

    def columns(self, table: str) -> Columns:
        """Columns of TABLE.csv, or of the `series`; SI."""
        if table == "series":
            return self._series
        path = self.directory / f"{table}.csv"
        try:
            return read_csv(path)
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}") from error
        except ValueError as error:
            raise InputError(f"{path}: not a table of a run: {error}") from error

    def table(self, name: str) -> Any:
        """As `columns`, as a pandas frame where pandas is there, else a structured array."""
        return frame(self.columns(name))

    @property
    def series(self) -> Any:
        """A row for each output: energies, counts, fronts, step size, error estimate."""
        return self.table("series")

    @property
    def energy(self) -> Any:
        """The energy account over time, J (J/m in plane strain)."""
        return self.table("energy")

    @property
    def events(self) -> Any:
        """Every event in order of time: `time`, `body`, `particle`, `kind`, place."""
        return self.table("events")

    @property
    def histories(self) -> dict[str, Any]:
        """Tables over time by name: `bodies`, and `reactions`, `contacts`, `probes` where the scene has such."""
        return {path.stem: self.table(path.stem) for path in sorted(self.directory.glob("*.csv")) if path.stem not in of_the_run}

    def frames_at(self, times: Sequence[float] | None) -> list[Frame]:
        """The outputs nearest to `times` (s), each once, by time; six spread over the run when none is given."""
        if not self.frames:
            return []
        stored = self.time
        wanted = np.linspace(stored[0], stored[-1], 6) if times is None else np.array(times)
        slack = np.max(np.diff(stored), initial=0.0)
        for time in wanted:
            if not stored[0] - slack <= time <= stored[-1] + slack:
                raise InputError(f"time {time * 1e6:g} us is outside the run: {stored[0] * 1e6:g} to {stored[-1] * 1e6:g} us")
        return [self.frames[i] for i in sorted({int(np.argmin(np.abs(stored - time))) for time in wanted})]


def load(directory: str | os.PathLike[str]) -> Run:
    """What a run left in its folder; raises InputError where there is none."""
    return Run(directory)
