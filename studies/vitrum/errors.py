"""What can go wrong, by the program's exit statuses."""
from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from vitrum.results import Run


class Error(Exception):
    """Of this package; the message is the program's, or one line."""


class InputError(Error):
    """A scene, a setting, a folder or a request is wrong (status 2)."""


class ComputationError(Error):
    """The computation failed (status 3): instability, or a tolerance out of reach. `run` holds what there is up to then."""

    def __init__(self, message: str, run: Run | None = None) -> None:
        super().__init__(message)
        self.run = run


class FileError(Error):
    """Reading or writing failed (status 4)."""
