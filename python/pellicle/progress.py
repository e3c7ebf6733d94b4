"""How far a solution is, shown as a bar or told to a function."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, TypeAlias


@dataclass(frozen=True, slots=True)
class Progress:
    """Where a solution stands."""

    step: int
    """Loading step under way, counted from 0; on small grids several are solved at the same time."""
    finished: int
    """Loading steps that are finished."""
    steps: int
    """Loading steps in all."""
    elements: int
    """Elements per side of the grid level under way."""
    iteration: int
    """Iteration on this level, counted from 0."""
    residual: float
    """Largest line of the certificate at this iterate, dimensionless."""

    def __str__(self) -> str:
        return f"grid {self.elements} × {self.elements}, iteration {self.iteration}, residual {self.residual:.1e}"


Report: TypeAlias = Callable[[Progress], object]
Raw: TypeAlias = tuple[int, int, int, int, int, float]


@contextmanager
def reporting(progress: bool | Report, title: str) -> Iterator[Callable[[Raw | None], None]]:
    """A function that passes progress on: to a bar if `progress` is true, or to `progress` itself."""
    if not progress:
        yield lambda raw: None
    elif callable(progress):
        yield _telling(progress)
    else:
        with _bar(title) as report:
            yield _telling(report)


def _telling(report: Report) -> Callable[[Raw | None], None]:
    """Tells what is new, and nothing twice."""
    last: Raw | None = None

    def tell(raw: Raw | None) -> None:
        nonlocal last
        if raw is not None and raw != last:
            last = raw
            report(Progress(*raw))

    return tell


@contextmanager
def _bar(title: str) -> Iterator[Report]:
    """A bar of tqdm, or a line on standard error where it is not installed."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield _write_line
        print(file=sys.stderr)
        return
    with tqdm(desc=title, unit="step") as bar:
        yield lambda progress: _advance(bar, progress)
        bar.update((bar.total or 0) - bar.n)


def _advance(bar: Any, progress: Progress) -> None:
    bar.total = progress.steps
    bar.set_postfix_str(str(progress), refresh=False)
    bar.update(progress.finished - bar.n)
    bar.refresh()


def _write_line(progress: Progress) -> None:
    line = f"\rstep {progress.finished + 1}/{progress.steps}, {progress}"
    print(line, end="", file=sys.stderr, flush=True)
