"""Runs the program: a scene, or one material point."""
from __future__ import annotations

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import weakref
from dataclasses import dataclass
from typing import Any, Mapping

from vitrum.errors import ComputationError, Error, FileError, InputError
from vitrum.program import overrides, program, toml_document
from vitrum.results import Run, load
from vitrum.tables import Columns, frame, read_csv

Source = str | os.PathLike[str] | Mapping[str, Any]


def _file_of(source: Source, folder: pathlib.Path) -> pathlib.Path:
    """A scene's file: the one that is named, or one made in `folder` of a text or of a table."""
    if isinstance(source, Mapping):
        text = toml_document(source)
    elif isinstance(source, str) and "\n" in source:
        text = source
    else:
        return pathlib.Path(source).absolute()
    path = folder / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return path


def _obey(arguments: list[str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(program()), *arguments], capture_output=True, text=True, encoding="utf-8", stdin=subprocess.DEVNULL)


def _error(done: subprocess.CompletedProcess[str]) -> Error:
    kinds = {2: InputError, 3: ComputationError, 4: FileError}
    return kinds.get(done.returncode, Error)(done.stderr.strip() or f"vitrum ended with status {done.returncode}")


def run(scene: Source, set: Mapping[str, Any] = {}, out: str | os.PathLike[str] | None = None, *, threads: int = 0, fields: bool = True) -> Run:
    """Runs a scene and returns its results.

    `scene`: a file, its text, or a table (dict). `set`: values by dotted path, None takes a key away. `out`: folder of the results, in which an
    earlier run is replaced; None: a temporary one, which goes when the results do. `threads`: 0 chooses. `fields=False` stores no particles.

    Raises InputError for a wrong scene, ComputationError (with `.run`) for a run that failed, FileError when a file could not be read or written.

    >>> from vitrum.program import studies
    >>> blocks = run(studies / "trade/impact.toml", {"time.end": 2e-6, "output.every": 1e-6})
    >>> blocks.summary["status"], len(blocks.frames)
    ('complete', 3)
    """
    folder = pathlib.Path(out) if out is not None else pathlib.Path(tempfile.mkdtemp(prefix="vitrum-"))
    with tempfile.TemporaryDirectory(prefix="vitrum-") as scratch:
        done = _obey(["run", str(_file_of(scene, pathlib.Path(scratch))), "--out", str(folder), "--force", "--quiet", "--threads", str(threads),
                      *([] if fields else ["--no-fields"]), *overrides(set)])
    result = load(folder) if done.returncode in (0, 3) and (folder / "result.h5").exists() else None
    if out is None:
        # The folder goes with the results; without any, now.
        removal = weakref.finalize(result if result is not None else done, shutil.rmtree, folder, ignore_errors=True)
        if result is None:
            removal()
    if done.returncode == 3:
        raise ComputationError(done.stderr.strip(), result)
    if result is None:
        raise _error(done)
    return result


@dataclass(frozen=True)
class Point:
    """One material point along its path. `columns`: name -> values (`t`, `e_rr`, .., `s_rr`, .., the law's state, `dissipated`), SI;
    `events`: (time, name), in order."""
    columns: Columns
    events: list[tuple[float, str]]

    def __getitem__(self, name: str) -> Any:
        return self.columns[name]

    @property
    def table(self) -> Any:
        """The columns as a pandas frame where pandas is there, else as a structured array."""
        return frame(self.columns)


def point(path: Source, set: Mapping[str, Any] = {}) -> Point:
    """Drives one material point along a path of strain: a point file, its text, or a table (dict).

    >>> steel = {"density": 7800.0, "young": 200e9, "poisson": 0.0}
    >>> pulled = point({"material": {"steel": steel}, "path": {"time": [0, 1e-6], "strain": [[0, 0, 0, 0], [1e-3, 0, 0, 0]], "size": 1e-3, "samples": 4}})
    >>> float(pulled["s_rr"][-1])
    200000000.0
    >>> pulled.events
    []
    """
    with tempfile.TemporaryDirectory(prefix="vitrum-") as scratch:
        table = pathlib.Path(scratch) / "point.csv"
        done = _obey(["point", str(_file_of(path, pathlib.Path(scratch))), "--out", str(table), *overrides(set)])
        if done.returncode != 0:
            raise _error(done)
        columns = read_csv(table)
    return Point(columns, [(float(time), name) for name, time in re.findall(r"^event (\S+) t=(\S+)", done.stderr, re.MULTILINE)])
