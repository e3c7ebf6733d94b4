"""A study: one case solved for many values of its keys, on any engine that runs functions."""

from __future__ import annotations

import functools
import os
import threading
import time
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _pellicle
from .case import checked_threads
from .curve import Curve
from .engines import Engine, outcomes
from .errors import ArgumentError, RunError, StudyWarning
from .given import switch
from .progress import StudyProgress, StudyReport, reporting
from .waiting import TURN

if TYPE_CHECKING:
    import pandas

FORCE_EVERY = 1.0
"""Seconds after which results are forced to the disk."""

MOST_CHUNKS = 1000
"""Chunks of a study of up to 100,000 cases: enough for some hundred workers, few enough for any scheduler."""

LARGEST_CHUNK = 100
"""Cases of a chunk: as many are solved again if their worker dies."""

MOST_BYTES = 1 << 24
"""Bytes of kept fields of a chunk, which travel together."""


def study(path: str | os.PathLike[str]) -> Study:
    """Reads a study from a file, as `pellicle study` does."""
    return Study(os.path.abspath(path))


class Study:
    """A base case and its varying keys, read from a file.

    Its pickle names the file, which must exist under the same path wherever cases are solved. Workers check that the
    study, its maps and the version of the package are the same.
    """

    def __init__(self, path: str) -> None:
        self.path = path
        """Its file."""
        self._study = _pellicle.Study(path, [])

    @property
    def name(self) -> str:
        """The name of its file, without the extension."""
        return self._study.name

    @property
    def title(self) -> str:
        """The title of its progress bar: its name."""
        return self.name

    def __len__(self) -> int:
        """Number of cases."""
        return len(self._study)

    def map(
        self,
        executor: Engine,
        *,
        out: str | os.PathLike[str] | None = None,
        fresh: bool = False,
        chunk: int | None = None,
        threads: int = 1,
        progress: bool | StudyReport = False,
    ) -> StudyTable:
        """Solves the cases on the workers of an engine, and writes the same table as `pellicle study`.

        `executor` is anything with `submit` or `map`, or a `joblib.Parallel`. Its workers solve `chunk` cases at a
        time, on `threads` threads each; rows are added to `results.csv` in the folder `out`, or else `results/NAME`, as
        soon as a chunk is done. Fields that the study keeps travel with the rows, into the same files as the program
        writes. Cases with rows in the table are not solved again unless `fresh` is set, so the same call continues
        after Ctrl-C or a failure of the engine. `progress` shows a bar, or is a function that receives a
        `StudyProgress`.

        Engines such as Dask and Ray solve a chunk again if its worker is lost. With others, finished cases are kept,
        the exception is raised, and the study can be mapped on a new executor.
        """
        folder = os.path.join("results", self.name) if out is None else out
        table = self._study.table(folder, switch("fresh", fresh))
        try:
            if self._study.refused is not None:
                warnings.warn(StudyWarning(self._study.refused, "invalid"), stacklevel=2)
            chunks = _chunks(table.remaining(), chunk, self._study.record_bytes)
            solve = _Solver(self, self.path, self._study.fingerprint, checked_threads(threads) or 1)
            with reporting(progress, self, StudyProgress) as report:
                said = self._gather(table, outcomes(executor, solve, chunks), solve, report)
            for message in sorted(said):
                warnings.warn(StudyWarning(message, "invalid"), stacklevel=2)
            found = StudyTable(os.fspath(table.path()), len(self), *table.tally())
        finally:
            table.close()
        if found.certified < found.cases:
            message = f"not every case is certified: {found}; see the column message"
            warnings.warn(StudyWarning(message, "not-certified"), stacklevel=2)
        return found

    def _gather(self, table: _pellicle.Table, ended: Any, solve: _Solver, report: Any) -> set[str]:
        """Adds the engine's results to the table; returns the warnings raised meanwhile."""
        said: set[str] = set()
        forced = time.monotonic()
        try:
            for rows, messages in ended:
                table.add(rows)
                said.update(messages)
                report((sum(table.tally()), len(self)))
                if time.monotonic() - forced > FORCE_EVERY:
                    table.force()
                    forced = time.monotonic()
        except BaseException as error:
            error.add_note(f"{sum(table.tally())} of {len(self)} cases are in {table.path()}: call map again")
            raise
        finally:
            solve.stopped.set()
            if hasattr(ended, "close"):
                ended.close()
            table.force()
        return said

    def __reduce__(self) -> tuple[Any, tuple[str, str]]:
        return _restored, (self.path, self._study.fingerprint)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Study):
            return NotImplemented
        return self._study.fingerprint == other._study.fingerprint

    def __hash__(self) -> int:
        return hash(self._study.fingerprint)

    def __repr__(self) -> str:
        return f"<Study {self.name!r}: {len(self)} cases>"


@dataclass(frozen=True)
class StudyTable:
    """The table of a finished study."""

    path: str
    """Its file, `results.csv`."""
    cases: int
    """Number of cases."""
    certified: int
    """Cases of which every step is certified."""
    not_converged: int
    """Cases with a result that is not certified."""
    cut_off: int
    """Cases whose contact is cut off by the edge of the domain or a map."""
    beyond_model: int
    """Cases with a result that is impossible for the model."""
    failed: int
    """Cases without a result; the column `message` has the reasons."""

    @cached_property
    def columns(self) -> Curve:
        """The columns as arrays; `pandas.DataFrame(table.columns)` is a table of them."""
        with open(self.path, encoding="utf-8", newline="") as file:
            return Curve.of_csv(file.read())

    def to_pandas(self) -> pandas.DataFrame:
        """The columns as a table with a row per loading step; needs pandas."""
        return self.columns.to_pandas()

    def plot(self, result: str, over: str, ax: Any = None) -> Any:
        """Draws a number of the result over a key with matplotlib, its ± as bars, certified cases alone, on `ax` or on
        new axes; returns the axes. Both are names of columns, with or without unit; of several loading steps all are
        drawn. `pellicle plot` draws pictures for paper."""
        import matplotlib.pyplot as plt

        ax = plt.subplots()[1] if ax is None else ax
        certified = self.columns["status"] == "certified"
        keys, numbers = self.columns[over][certified], self.columns[result][certified]
        errors = f"{result.partition(' [')[0]} error"
        has_errors = any(name.partition(" [")[0] == errors for name in self.columns)
        yerr = np.nan_to_num(self.columns[errors][certified].astype(float)) if has_errors else None
        ax.errorbar(keys, numbers, yerr=yerr, marker="o", linestyle="none", capsize=2)
        ax.set(xlabel=over, ylabel=result)
        return ax

    def __str__(self) -> str:
        words = {
            "certified": self.certified,
            "not converged": self.not_converged,
            "cut off": self.cut_off,
            "beyond the model": self.beyond_model,
            "failed": self.failed,
        }
        return f"{self.cases} cases, " + ", ".join(f"{count} {word}" for word, count in words.items() if count)


class _Solver:
    """Solves chunks of cases, in any process."""

    def __init__(self, study: Study | None, path: str, fingerprint: str, threads: int) -> None:
        self.study = study
        """None elsewhere: an engine may break if it is read, and perhaps refused, where a task is unpickled."""
        self.path = path
        self.fingerprint = fingerprint
        self.threads = threads
        self.stopped = threading.Event()
        """Set if nobody waits any more; visible only to threads of the same process."""

    def __call__(self, cases: list[int]) -> tuple[list[tuple[int, str, str, bytes]], list[str]]:
        """Solves these cases; returns their rows with kept fields, and warnings."""
        study = self.study or _restored(self.path, self.fingerprint)
        run = study._study.start(cases, self.threads)
        try:
            while not run.wait(TURN):
                if self.stopped.is_set():
                    run.cancel()
        except BaseException:
            run.cancel()
            raise
        return run.result()

    def __reduce__(self) -> tuple[type[_Solver], tuple[None, str, str, int]]:
        return _Solver, (None, self.path, self.fingerprint, self.threads)


def _chunks(cases: list[int], size: int | None, record_bytes: int) -> list[list[int]]:
    if size is None:
        most = min(LARGEST_CHUNK, MOST_BYTES // max(1, record_bytes))
        size = max(1, min(-(-len(cases) // MOST_CHUNKS), most))
    if isinstance(size, bool) or not size >= 1:
        raise ArgumentError(f"chunk: found {size}, wanted a number of cases, at least 1")
    return [cases[start : start + size] for start in range(0, len(cases), size)]


@functools.lru_cache(maxsize=4)
def _restored(path: str, fingerprint: str) -> Study:
    """Reads the study of another process from its file; cached, since every chunk refers to it."""
    found = Study(path)
    if found._study.fingerprint != fingerprint:
        found_here = "another study, other maps or another version of pellicle"
        raise RunError(f"{path}: found {found_here}, wanted those of the process that called map")
    return found
