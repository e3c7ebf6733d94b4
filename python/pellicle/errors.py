"""Exceptions: one class for each kind of error of the program, all of them an `Error`."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ._pellicle import (
    CaseError,
    ContactError,
    Error,
    IdentifyError,
    IndenterError,
    InfluenceError,
    InternalError,
    KernelError,
    RunError,
    TextureError,
)

if TYPE_CHECKING:
    from .path import Path
    from .waiting import Run

__all__ = [
    "ArgumentError",
    "CaseError",
    "ContactError",
    "Error",
    "FitWarning",
    "IdentifyError",
    "IndenterError",
    "InfluenceError",
    "InternalError",
    "Interrupted",
    "KernelError",
    "NotCertifiedWarning",
    "RunError",
    "StudyWarning",
    "TextureError",
]


class ArgumentError(Error, ValueError):
    """An argument is of the wrong type, shape or value; the message begins with its name."""


class FitWarning(UserWarning):
    """A fit is not to be used: its model does not follow the measurements, or it has not converged."""


class StudyWarning(UserWarning):
    """Cases of a study are invalid, have failed, or are not certified."""


class NotCertifiedWarning(UserWarning):
    """A solution is not certified: not converged, or cut off by the domain or the end of a map."""


class Interrupted(KeyboardInterrupt):
    """The user has stopped a solution or a fit with Ctrl-C."""

    def __init__(self, run: Run, made: Callable[[Any], Any]) -> None:
        super().__init__("stopped by the user; `.result` holds what was finished")
        self._made = made
        self._run: Run | None = run
        self._result: Any = None

    @property
    def result(self) -> Any:
        """What was finished: the path of some loading steps, or a fit without some intervals; None if nothing was.

        Waits for the iteration under way, which on large grids may take some tenths of a second.
        """
        if self._run is not None:
            while not self._run.wait(20):
                pass
            result, self._run = self._run.result(), None
            self._result = None if result is None else self._made(result)
        return self._result

    @property
    def path(self) -> Path | None:
        """The path of the loading steps that were finished; None if there are none."""
        from .path import Path

        return self.result if isinstance(self.result, Path) else None
