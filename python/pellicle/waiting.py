"""Waits for running work, reports its progress, and stops it on Ctrl-C."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from typing import Any, Protocol, TypeVar

from ._pellicle import InternalError

TURN = 20
"""Milliseconds between two checks of signals and progress."""

PATIENCE = 100
"""Milliseconds in which interrupted work may end before it is left behind."""

Found = TypeVar("Found")


class Run(Protocol):
    """Running work."""

    def wait(self, milliseconds: int, /) -> bool:
        """Waits at most this long; returns whether the work is finished."""
        ...

    def cancel(self) -> None:
        """Asks the work to end."""
        ...

    def progress(self) -> Any:
        """Its progress."""
        ...

    def result(self) -> Any:
        """The result; None if the work was stopped before there was one."""
        ...


class Interrupted(KeyboardInterrupt):
    """The user stopped a solution or a fit with Ctrl-C."""

    def __init__(self, run: Run, made: Callable[[Any], Any]) -> None:
        super().__init__("stopped by the user; `.result` holds what was finished")
        self._made = made
        self._run: Run | None = run
        self._result: Any = None

    @property
    def result(self) -> Any:
        """The finished part: the path of some loading steps, or a fit without some intervals; None if nothing was
        finished.

        Waits for the current iteration, which on large grids may take a few tenths of a second.
        """
        if self._run is not None:
            while not self._run.wait(20):
                pass
            result, self._run = self._run.result(), None
            self._result = None if result is None else self._made(result)
        return self._result

    @property
    def path(self) -> Any:
        """The path of the finished loading steps; None if there are none."""
        return self.result if isinstance(self.result, Sequence) else None


def finished(
    run: Run, made: Callable[[Any], Found], reporting: AbstractContextManager[Callable[[Any], None]]
) -> Found:
    """Waits for work and converts its result. Ctrl-C raises `Interrupted`."""
    try:
        with reporting as report:
            while not run.wait(TURN):
                report(run.progress())
            report(run.progress())
    except KeyboardInterrupt:
        run.cancel()
        run.wait(PATIENCE)
        raise Interrupted(run, made) from None
    except BaseException:
        run.cancel()
        raise
    result = run.result()
    if result is None:
        raise InternalError("found no result although the work was not stopped")
    return made(result)
