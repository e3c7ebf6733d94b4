"""Waits for work under way, tells how far it is, and stops it with Ctrl-C."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any, Protocol, TypeVar

from ._pellicle import InternalError
from .errors import Interrupted

TURN = 20
"""Milliseconds between two looks at signals and progress."""

PATIENCE = 100
"""Milliseconds in which interrupted work may end before it is left behind."""

Found = TypeVar("Found")


class Run(Protocol):
    """Work under way."""

    def wait(self, milliseconds: int, /) -> bool:
        """Waits at most so long; whether the work is finished."""
        ...

    def cancel(self) -> None:
        """Asks the work to end."""
        ...

    def progress(self) -> Any:
        """How far it is."""
        ...

    def result(self) -> Any:
        """What was found; None if nothing was before the work was stopped."""
        ...


def finished(
    run: Run, made: Callable[[Any], Found], reporting: AbstractContextManager[Callable[[Any], None]]
) -> Found:
    """What is made of the result of some work. Ctrl-C raises `Interrupted`."""
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
        raise InternalError("found no result where nobody stopped the work")
    return made(result)
