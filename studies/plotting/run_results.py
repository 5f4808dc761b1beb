"""Reads what a run leaves in its folder."""
import csv
import json
import pathlib
import tomllib

import h5py
import numpy as np


class BadInput(Exception):
    """What is asked for cannot be drawn; the message is one line."""


class Frame:
    """The particles at one output: time (s), position (N x 2, m), and the other fields on demand."""

    def __init__(self, step):
        self.time = float(step.attrs["time"])
        self._fields = {name: step["particles"][name][()] for name in step["particles"]}
        self.position = self._fields["position"]

    def field(self, name):
        """N values; NaN where the particle's material lacks the model. None: no particle has it."""
        values = self._fields.get(name)
        return None if values is None or np.all(np.isnan(values)) else values

    def separated(self):
        decohesion = self.field("decohesion")
        if decohesion is None:
            return np.zeros(len(self.position), bool)
        return np.nan_to_num(decohesion) >= 1.0

    def opening(self):
        """Length of the opening vector (m), eq. 14; None: no decohesion."""
        normal, tangential = self.field("opening_n"), self.field("opening_t")
        return None if normal is None or tangential is None else np.hypot(normal, tangential)

    def plane(self):
        """Which particles have localised (N), and the normals of their planes (N x 2; both components 0: across the hoop direction). None: not stored."""
        length, normal_r, normal_z = self.field("effective_length"), self.field("normal_r"), self.field("normal_z")
        if length is None or normal_r is None or normal_z is None:
            return None
        return np.nan_to_num(length) > 0.0, np.nan_to_num(np.column_stack([normal_r, normal_z]))


class RunResults:
    """A finished, interrupted or killed run. Raises BadInput when the folder does not hold one."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        path = self.directory / "result.h5"
        if not path.is_file():
            raise BadInput(f"{path}: no such file; expected the folder of a run")
        try:
            with h5py.File(path) as result:
                if result.attrs.get("format") != "vitrum result 3":
                    raise BadInput(f"{path}: not a vitrum result of this version")
                self.title = str(result.attrs["title"])
                self.provenance = {name: str(value) for name, value in result["provenance"].attrs.items() if not name.startswith(".")}
                # Columns over the outputs: SI.
                self.series = {name: values[()] for name, values in result["series"].items()} if "series" in result else {}
                self._read_scene(result)
                self._read_particles(result)
        except (OSError, KeyError) as error:
            raise BadInput(f"{path}: cannot be read: {error}".replace("\n", " ")) from error
        self.energy = self._read_energy()
        self.summary = self._read_summary()

    def _read_scene(self, result):
        self.resolved = result["scene/resolved"][()].decode()
        self.scene = scene = tomllib.loads(self.resolved)
        self.axisymmetric = scene["space"]["geometry"] == "axisymmetric"
        self.cell = scene["space"]["cell"]
        self.bodies = [body["name"] for body in scene["body"]]
        self.materials = [body["material"] for body in scene["body"]]
        self._sides = [self.cell / np.sqrt(body["particles_per_cell"]) for body in scene["body"]]

    def _read_particles(self, result):
        """`frames` stays empty where the run was made with --no-fields."""
        self.frames = [Frame(step) for step in result["steps"].values() if "particles" in step] if "steps" in result else []
        if not self.frames:
            return
        self.body, self.mass = result["particles/body"][()], result["particles/mass"][()]
        # What each particle's square measures at the start (m).
        self.side = np.array(self._sides)[self.body]

    def _read_energy(self):
        """Columns of energy.csv, J (J/m in plane strain)."""
        path = self.directory / "energy.csv"
        try:
            with open(path, newline="") as file:
                rows = list(csv.reader(file))
            # A line without all its columns was cut off by a kill.
            complete = [row for row in rows[1:] if len(row) == len(rows[0])]
            columns = np.array(complete, float).T
            return dict(zip(rows[0], columns, strict=True))
        except OSError as error:
            raise BadInput(f"{path}: {error.strerror}") from error
        except (ValueError, IndexError) as error:
            raise BadInput(f"{path}: not an energy account: {error}") from error

    def _read_summary(self):
        """None while the run is under way, or when it was killed."""
        path = self.directory / "summary.json"
        try:
            return json.loads(path.read_text()) if path.exists() else None
        except ValueError as error:
            raise BadInput(f"{path}: not JSON: {error}") from error

    def frames_at(self, times):
        """The outputs nearest to `times` (s), each once, by time; six spread over the run when none is given."""
        if not self.frames:
            return []
        stored = np.array([frame.time for frame in self.frames])
        wanted = np.linspace(stored[0], stored[-1], 6) if times is None else np.array(times)
        slack = np.max(np.diff(stored), initial=0.0)
        for time in wanted:
            if not stored[0] - slack <= time <= stored[-1] + slack:
                raise BadInput(f"time {time * 1e6:g} us is outside the run: {stored[0] * 1e6:g} to {stored[-1] * 1e6:g} us")
        return [self.frames[i] for i in sorted({int(np.argmin(np.abs(stored - time))) for time in wanted})]
