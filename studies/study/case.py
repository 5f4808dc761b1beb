"""A case: one scene, changed by --set. The only place that knows the program's command line."""
import functools
import hashlib
import os
import subprocess
from dataclasses import dataclass, field

from vitrum.program import overrides, program, studies

root = studies.parent


@dataclass(frozen=True)
class Case:
    """`name` is its folder, `scene` a file below studies/, `settings` are scene keys by dotted path."""
    name: str
    scene: str
    settings: dict = field(default_factory=dict)
    fields: bool = True
    longest: float = 600.0  # s: a run that takes longer is stopped, and counts as such

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


def check(case):
    """Validates the scene; the message, or nothing when it is valid."""
    done = subprocess.run(check_command(case), capture_output=True, text=True)
    return "" if done.returncode == 0 else f"case {case.name}: exit status {done.returncode}: {done.stderr.strip()}"
