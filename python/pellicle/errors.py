"""Exceptions: one class for each kind of error of the program, all of them an `Error`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._pellicle import (
    CaseError,
    ContactError,
    Error,
    IndenterError,
    InfluenceError,
    InternalError,
    KernelError,
    RunError,
    TextureError,
)

if TYPE_CHECKING:
    from ._pellicle import Run
    from .case import Case
    from .path import Path

__all__ = [
    "ArgumentError",
    "CaseError",
    "ContactError",
    "Error",
    "IndenterError",
    "InfluenceError",
    "InternalError",
    "Interrupted",
    "KernelError",
    "NotCertifiedWarning",
    "RunError",
    "TextureError",
]


class ArgumentError(Error, ValueError):
    """An argument is of the wrong type, shape or value; the message begins with its name."""


class NotCertifiedWarning(UserWarning):
    """A solution is not certified: not converged, or cut off by the domain or the end of a map."""


class Interrupted(KeyboardInterrupt):
    """The user has stopped a solution with Ctrl-C."""

    def __init__(self, case: Case, run: Run) -> None:
        super().__init__("stopped by the user; `.path` holds the loading steps that were finished")
        self._case = case
        self._run: Run | None = run
        self._path: Path | None = None

    @property
    def path(self) -> Path | None:
        """The path of the loading steps that were finished; None if there are none.

        Waits for the iteration under way, which on large grids may take some tenths of a second.
        """
        from .path import path_of

        if self._run is not None:
            while not self._run.wait(20):
                pass
            solution, self._run = self._run.result(), None
            self._path = None if solution is None else path_of(self._case, solution)
        return self._path
