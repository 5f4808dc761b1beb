"""A case: one scene, changed by --set. The only place that knows the program's command line."""
import functools
import hashlib
import os
import subprocess
import tomllib
from dataclasses import dataclass, field

from vitrum.program import overrides, program, studies

root = studies.parent


@dataclass(frozen=True)
class Case:
    """`name` is its folder, `scene` a file below studies/, `settings` are scene keys by dotted path, `told` the study file that says them, if one does."""
    name: str
    scene: str
    settings: dict = field(default_factory=dict)
    fields: bool = True
    longest: float = 600.0  # s: a run that takes longer is stopped, and counts as such
    told: str = field(default="", compare=False)

    def overrides(self):
        return overrides(self.settings)


def run_command(case, folder):
    """The arguments of a run. Threads stay at one: cases run side by side."""
    return [str(program()), "run", str(studies / case.scene), "--out", str(folder), "--force", "--quiet", "--threads", "1",
            *([] if case.fields else ["--no-fields"]), *case.overrides()]


def check_command(case):
    return [str(program()), "check", str(studies / case.scene), *case.overrides()]


def as_typed(case):
    """The run as one would type it in the project's root."""
    words = ["vitrum", "run", os.path.relpath(studies / case.scene, root), *case.overrides()]
    return " ".join(f"'{word}'" if set(word) & set(' "{[') else word for word in words)


@functools.cache
def digest(path):
    """SHA-256 of a file: results of another program or scene are made anew."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def inputs(scene, settings):
    """File -> SHA-256 (None: there is none) of the scene, and of all tables and pictures that it or settings of cases name: {csv = "FILE"}, {file = "FILE"}."""
    scene = studies / scene
    names = {scene.name, *_named_by(scene), *(name for each in settings for name in _named(each))}
    return {name: digest(scene.parent / name) if (scene.parent / name).is_file() else None for name in sorted(names)}


@functools.cache
def _named_by(scene):
    try:
        return [*_named(tomllib.loads(scene.read_text(encoding="utf-8")))]
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, OSError):
        return []  # the program says so, with the place


def _named(value):
    """The names of files in a table; its keys may be dotted paths."""
    if isinstance(value, dict):
        for key, item in value.items():
            if key.rpartition(".")[2] in ("csv", "file") and isinstance(item, str):
                yield item
            else:
                yield from _named(item)
    elif isinstance(value, list):
        for item in value:
            yield from _named(item)


def check(case):
    """Validates the scene; the message, or nothing when it is valid."""
    done = subprocess.run(check_command(case), capture_output=True, text=True)
    return "" if done.returncode == 0 else f"case {case.name}: exit status {done.returncode}: {done.stderr.strip()}"
