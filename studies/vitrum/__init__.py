"""vitrum from Python: runs scenes and material points, reads what they leave, draws it.

    import vitrum
    run = vitrum.run("impact.toml", {"integrator.courant": 0.2})   # or vitrum.load("out/impact")
    run.frames[-1]["velocity"]                                     # N x 2, m/s
    run.events, run.histories["bodies"], run.summary["energy"]
    vitrum.plot.snapshots(run).savefig("impact.png")
"""
from __future__ import annotations

from typing import Any

from vitrum.errors import ComputationError, Error, FileError, InputError
from vitrum.results import Frame, Run, load
from vitrum.running import Point, point, run

__all__ = ["ComputationError", "Error", "FileError", "Frame", "InputError", "Point", "Run", "load", "plot", "point", "report", "run"]


def __getattr__(name: str) -> Any:
    """`vitrum.plot` and `vitrum.report` are imported when they are first asked for: they want matplotlib."""
    if name in ("plot", "report"):
        import importlib
        return importlib.import_module(f"vitrum.{name}")
    raise AttributeError(f"module 'vitrum' has no attribute {name!r}")
