"""The progress of a solution, shown as a bar or passed to a function."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

from .given import switch


@dataclass(frozen=True, slots=True)
class Progress:
    """The progress of a solution."""

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

    @classmethod
    def of(cls, raw: tuple[int, int, int, int, int, float]) -> Progress:
        """Makes a progress from its numbers."""
        return cls(*raw)

    @property
    def done(self) -> tuple[int, int | None, str]:
        """Number of finished parts of the work, their total, and the name of a part."""
        return self.finished, self.steps, "step"

    def __str__(self) -> str:
        return f"grid {self.elements} × {self.elements}, iteration {self.iteration}, residual {self.residual:.1e}"


@dataclass(frozen=True, slots=True)
class FitProgress:
    """The progress of a fit or a plan."""

    solved: int | None
    """Predictions of all curves made so far; None while a design is planned."""
    planned: int | None
    """Curves of the design assessed so far; None during the fit."""

    @classmethod
    def of(cls, raw: tuple[int | None, int | None]) -> FitProgress:
        """Makes a progress from its numbers."""
        return cls(*raw)

    @property
    def done(self) -> tuple[int, int | None, str]:
        """Number of finished parts of the work, their total, and the name of a part."""
        return self.solved or self.planned or 0, None, "curve"

    def __str__(self) -> str:
        return f"{self.solved} curves solved" if self.planned is None else f"{self.planned} curves planned"


@dataclass(frozen=True, slots=True)
class StudyProgress:
    """The progress of a study."""

    finished: int
    """Cases in its table."""
    cases: int
    """Cases in all."""

    @classmethod
    def of(cls, raw: tuple[int, int]) -> StudyProgress:
        """Makes a progress from its numbers."""
        return cls(*raw)

    @property
    def done(self) -> tuple[int, int | None, str]:
        """Number of finished parts of the work, their total, and the name of a part."""
        return self.finished, self.cases, "case"

    def __str__(self) -> str:
        return f"{self.finished} of {self.cases} cases"


@dataclass(frozen=True, slots=True)
class SearchProgress:
    """The progress of a search."""

    tried: int
    """Cases tried."""

    @classmethod
    def of(cls, raw: int) -> SearchProgress:
        """Makes a progress from its number."""
        return cls(raw)

    @property
    def done(self) -> tuple[int, int | None, str]:
        """Number of finished parts of the work, their total, and the name of a part."""
        return self.tried, None, "case"

    def __str__(self) -> str:
        return f"{self.tried} cases tried"


Report: TypeAlias = Callable[[Progress], object]
StudyReport: TypeAlias = Callable[[StudyProgress], object]
SearchReport: TypeAlias = Callable[[SearchProgress], object]
FitReport: TypeAlias = Callable[[FitProgress], object]


Kind: TypeAlias = type[Progress] | type[FitProgress] | type[StudyProgress] | type[SearchProgress]
"""The type in which progress is reported."""


class Titled(Protocol):
    """A case, a fit, a study or a search."""

    @property
    def title(self) -> str:
        """The title of the progress bar."""
        ...


@contextmanager
def reporting(
    progress: bool | Callable[[Any], object], of: Titled, kind: Kind
) -> Iterator[Callable[[Any], None]]:
    """A function that reports progress to a bar if `progress` is true, or to `progress` itself."""
    if callable(progress):
        yield _reporting(progress, kind)
    elif not switch("progress", progress, " or a function"):
        yield lambda raw: None
    else:
        with _bar(of.title) as report:
            yield _reporting(report, kind)


def _reporting(
    report: Callable[[Any], object], kind: Kind
) -> Callable[[Any], None]:
    """Reports only changes of the progress."""
    last: Any = None

    def report_change(raw: Any) -> None:
        nonlocal last
        if raw is not None and raw != last:
            last = raw
            report(kind.of(raw))

    return report_change


@contextmanager
def _bar(title: str) -> Iterator[Callable[[Any], object]]:
    """A tqdm bar, or a line on standard error if tqdm is not installed."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield _write_line
        print(file=sys.stderr)
        return
    with tqdm(desc=title) as bar:
        yield lambda progress: _advance(bar, progress)
        bar.update((bar.total or 0) - bar.n)


def _advance(bar: Any, progress: Progress | FitProgress | StudyProgress | SearchProgress) -> None:
    done, bar.total, bar.unit = progress.done
    bar.set_postfix_str(str(progress), refresh=False)
    bar.update(done - bar.n)
    bar.refresh()


def _write_line(progress: Progress | FitProgress | StudyProgress | SearchProgress) -> None:
    done, parts, part = progress.done
    line = f"\r{progress}" if not isinstance(progress, Progress) else f"\r{part} {done + 1}/{parts}, {progress}"
    print(line, end="", file=sys.stderr, flush=True)
