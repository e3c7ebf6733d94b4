"""A search for the smallest or largest value of a key for which a condition on a result holds."""

from __future__ import annotations

import json
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from . import _pellicle
from .case import Case, checked_threads
from .curve import Curve
from .errors import ArgumentError, StudyWarning
from .given import part, taken
from .progress import SearchProgress, SearchReport, reporting
from .quantity import Quantity, number, unit_of, written
from .waiting import finished

if TYPE_CHECKING:
    import pandas


def find(
    case: Case,
    condition: str,
    *,
    by: str,
    between: Sequence[Quantity] | None = None,
    within: float = 1e-3,
    progress: bool | SearchReport = False,
    threads: int | None = None,
) -> Found:
    """Finds the value of the key `by` at which a condition on a number of the result ceases or begins to hold.

    `condition` is a number of the last loading step, by its key in `docs/results.md` or its name in tables, and its
    limit: `"max_pressure < 2 GPa"`. `between` are the ends of the range of the key, by default a decade down and up
    from its value in the case. The answer is bracketed to the part `within` of it, on certified cases alone.

    The cases are those that `pellicle study --find` solves. Without an answer `value` is None, and a `StudyWarning`
    says why.
    """
    part("case", case, Case)
    for name, text in (("condition", condition), ("by", by)):
        if not isinstance(text, str):
            raise ArgumentError(f"{name}: found {type(text).__name__}, wanted a string")
    if not 1e-9 <= number("within", within, "dimensionless") <= 0.1:
        raise ArgumentError(f"within: found {within}, wanted a number from 1e-9 to 0.1")
    run = _pellicle.find(case._state, condition, by, _ends(between, by), within, checked_threads(threads))
    return finished(run, _found, reporting(progress, case, SearchProgress))


def _ends(between: Sequence[Quantity] | None, by: str) -> tuple[str, str] | None:
    """The ends of the range as texts."""
    if between is None:
        return None
    ends = taken("between", between)
    if not isinstance(ends, tuple) or len(ends) != 2:
        raise ArgumentError(f"between: found {between!r}, wanted the two ends of the range")
    low, high = (str(written(end, "between", unit_of(by) or "dimensionless")) for end in ends)
    return low, high


@dataclass(frozen=True, repr=False)
class Found:
    """What a search has found."""

    verdict: Literal["found", "holds-at-both-ends", "holds-at-neither-end", "blocked"]
    """How it has ended; `blocked` if a case on the way is not certified."""
    key: str
    """The key."""
    unit: str | None
    """The unit of its values; None for a number without a unit."""
    extreme: Literal["largest", "smallest"] | None
    """Whether the condition holds up to the answer or from it."""
    value: float | None
    """The value at which the number meets its limit."""
    interval: tuple[float, float] | None
    """The interval in which the number ± its error straddles the limit; None if the error is not resolved."""
    notes: tuple[str, ...]
    """What is to be known about the answer, or why there is none."""
    limit: float
    """The limit of the number."""
    result: str
    """The name of the number."""
    cases: Curve
    """The cases tried, in their order: value of the key, number, error, warnings."""

    def to_pandas(self) -> pandas.DataFrame:
        """The cases tried as a table; needs pandas."""
        return self.cases.to_pandas()

    def plot(self, ax: Any = None) -> Any:
        """Draws the number over the key with matplotlib on `ax` or on new axes, with limit and answer, and returns the
        axes."""
        import matplotlib.pyplot as plt
        import numpy as np

        ax = plt.subplots()[1] if ax is None else ax
        keys, number = self.cases[self.key], self.cases[self.result]
        error = np.nan_to_num(self.cases[f"{self.result} error"].astype(float))
        order = np.argsort(keys)
        ax.errorbar(keys[order], number[order], yerr=error[order], marker="o", capsize=2)
        ax.axhline(self.limit, color="tab:orange", linestyle="--")
        if self.interval is not None:
            ax.axvspan(*self.interval, color="tab:green", alpha=0.3)
        if self.value is not None:
            ax.axvline(self.value, color="tab:green")
        names = {name.partition(" [")[0]: name for name in self.cases}
        ax.set(xlabel=names[self.key], ylabel=names[self.result])
        if min(keys) > 0:
            ax.set_xscale("log")
        return ax

    def __repr__(self) -> str:
        if self.value is None:
            return f"<Found {self.verdict}: {'; '.join(self.notes)}>"
        unit = "" if self.unit is None else f" {self.unit}"
        inside = "" if self.interval is None else f" [{self.interval[0]:.6g}, {self.interval[1]:.6g}]"
        return f"<Found {self.extreme} {self.key} = {self.value:.6g}{unit}{inside}>"


def _found(result: tuple[str, str]) -> Found:
    """Makes what was found; warns if there is no answer."""
    raw, table = json.loads(result[0]), Curve.of_csv(result[1])
    found = Found(
        verdict=raw["verdict"],
        key=raw["key"],
        unit=raw["unit"],
        extreme=raw["extreme"],
        value=raw["value"],
        interval=None if raw["interval"] is None else (raw["interval"][0], raw["interval"][1]),
        notes=tuple(raw["notes"]),
        limit=raw["limit"],
        result=raw["result"],
        cases=table,
    )
    if found.value is None:
        warnings.warn(StudyWarning("; ".join(found.notes), found.verdict), stacklevel=4)
    return found
