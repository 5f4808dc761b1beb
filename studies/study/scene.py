"""A scene as the program reads it."""
import json
import subprocess
import tomllib

from study.reader import StudyFileError
from vitrum.program import overrides, program


def resolved(scene, settings):
    """The scene as the program reads it; StudyError with its message and place where it is refused."""
    checked = answer(scene, settings)
    if checked.returncode != 0:
        raise StudyFileError(checked.stderr.strip())
    return tomllib.loads(json.loads(checked.stdout)["resolved"])


def answer(scene, settings):
    return subprocess.run([program(), "check", scene, "--json", *overrides(settings)], capture_output=True, text=True)
