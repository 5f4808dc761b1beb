"""The program: where it is, and how it is told what to do."""
from __future__ import annotations

import json
import math
import os
import pathlib
import re
import shutil
from typing import Any, Mapping

from vitrum.errors import InputError

studies = pathlib.Path(__file__).resolve().parent.parent


def program() -> pathlib.Path:
    """The program: $VITRUM, that of the tree or of the prefix in which this package stands, or the first on PATH."""
    named = os.environ.get("VITRUM")
    if named:
        return pathlib.Path(named).resolve()
    for beside in (studies.parent / "build/release/src/app/vitrum", studies.parent.parent.parent / "bin/vitrum"):
        if beside.is_file():
            return beside
    found = shutil.which("vitrum")
    if found is None:
        raise InputError("the program vitrum is not found: build it (./quickstart), or name it in the environment variable VITRUM")
    return pathlib.Path(found).resolve()


def _key(name: str) -> str:
    return name if re.fullmatch(r"[\w-]+", name, re.ASCII) else json.dumps(name)


def toml(value: Any) -> str:
    """The value as TOML; None is `none`, which takes a key away in `--set`.

    >>> toml({"min": [0, 0.5], "name": "one", "inf": float("inf")})
    '{min = [0, 0.5], name = "one", inf = inf}'
    """
    if value is None:
        return "none"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(float(value)) if math.isfinite(value) else str(float(value))
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(key)} = {toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    if hasattr(value, "tolist"):  # numpy's numbers and arrays
        return toml(value.tolist())
    raise InputError(f"no TOML value: {value!r}")


def toml_document(table: Mapping[str, Any]) -> str:
    """A whole file of a table.

    >>> print(toml_document({"title": "two", "space": {"cell": 0.5}}), end="")
    title = "two"
    space = {cell = 0.5}
    """
    return "".join(f"{_key(key)} = {toml(value)}\n" for key, value in table.items())


def overrides(settings: Mapping[str, Any]) -> list[str]:
    """The settings as arguments, by dotted path.

    >>> overrides({"space.cell": 1e-3, "integrator.scheme": "musl"})
    ['--set', 'space.cell=0.001', '--set', 'integrator.scheme="musl"']
    """
    return [text for key, value in settings.items() for text in ("--set", f"{key}={toml(value)}")]
