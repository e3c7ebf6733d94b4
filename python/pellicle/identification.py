"""The results of fits and plans, and the functions that compute them."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from . import fit_views, show
from .case import checked_threads
from .curve import Curve
from .errors import ArgumentError, FitWarning
from .estimates import ExpectedDesign, FitEstimate, design_of, estimate_of
from .fit import Fit
from .judgement import ResultWarning
from .progress import FitProgress, FitReport, reporting
from .waiting import finished

Files = tuple[str, list[tuple[str, str]], bool]
"""JSON, tables by the names of their files, and whether the work was finished."""


class Result:
    """The result of a fit, of fits of each curve, or a plan, as in its results file."""

    def __init__(self, fit: Fit, found: dict[str, Any], tables: Mapping[str, str], is_whole: bool) -> None:
        self.fit = fit
        """The fit as it was given."""
        self._found = found
        self._tables = dict(tables)
        self.is_whole = is_whole
        """Whether everything that was requested is here; otherwise it was interrupted."""

    def to_dict(self) -> dict[str, Any]:
        """The content of the results file: only numbers, strings, lists and dicts."""
        found: dict[str, Any] = json.loads(json.dumps(self._found))
        return found

    @cached_property
    def warnings(self) -> list[ResultWarning]:
        """Warnings about the result."""
        return [ResultWarning(**warning) for warning in self._found["warnings"]]

    @property
    def work(self) -> dict[str, Any]:
        """Its cost: `curves_solved`, `loads_solved`, `seconds`, …"""
        work: dict[str, Any] = self._found["work"]
        return work

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self) or not isinstance(other, Result):
            return NotImplemented
        return self.fit == other.fit and _timeless(self._found) == _timeless(other._found)

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> Result:
        return self

    def __deepcopy__(self, memo: object) -> Result:
        return self

    def __reduce__(self) -> tuple[type[Result], tuple[Any, ...]]:
        return type(self), (self.fit, self._found, self._tables, self.is_whole)


class Identification(Result):
    """The result of a fit. `result["indenter.radius"]` is the estimate for a key."""

    @property
    def verdict(self) -> str:
        """`"fitted"`, `"misfit"`, `"outside-model"` or `"not-converged"`; only a fitted result may be used."""
        verdict: str = self._found["verdict"]
        return verdict

    @cached_property
    def unknowns(self) -> list[FitEstimate]:
        """Estimates of the unknowns, in their order."""
        return [estimate_of(found) for found in self._found["unknowns"]]

    @cached_property
    def nuisances(self) -> list[FitEstimate]:
        """Estimates of the inexactly known numbers."""
        return [estimate_of(found) for found in self._found["nuisances"]]

    def __getitem__(self, key: str) -> FitEstimate:
        for estimate in (*self.unknowns, *self.nuisances):
            if estimate.key == key:
                return estimate
        raise KeyError(key)

    def __iter__(self) -> Iterator[FitEstimate]:
        return iter(self.unknowns)

    @property
    def correlation(self) -> npt.NDArray[np.float64]:
        """Correlation of the unknowns, in their order."""
        return np.array(self._found["correlation"], dtype=np.float64)

    @cached_property
    def curve(self) -> Curve:
        """The columns of `fit.csv`: every point with model and residual; `pandas.DataFrame(result.curve)` is a
        table."""
        return Curve.of_csv(self._tables["fit.csv"])

    @cached_property
    def covariance(self) -> npt.NDArray[np.float64]:
        """Covariance of the logarithms of all estimates, unknowns first, as in `covariance.csv`."""
        rows = [line.split(",")[1:] for line in self._tables["covariance.csv"].splitlines()[1:]]
        return np.array([[float(cell or "nan") for cell in row] for row in rows], dtype=np.float64)

    @cached_property
    def profiles(self) -> Curve:
        """The columns of `profiles.csv`: the likelihood along each unknown."""
        return Curve.of_csv(self._tables["profiles.csv"])

    @property
    def taken_as_exact(self) -> list[dict[str, Any]]:
        """Numbers that the model holds fixed: `key`, `unit`, `value`, and `exponents`, the change of each unknown in
        percent for an increase of 1 %."""
        numbers: list[dict[str, Any]] = self._found["taken_as_exact"]
        return numbers

    @property
    def goodness(self) -> dict[str, Any]:
        """How well the model fits the data: `chi_squared_per_degree`, `misfit_p`, `noise`, `excluded`, `outliers`,
        `departure`, …"""
        goodness: dict[str, Any] = self._found["fit"]
        return goodness

    @property
    def curves(self) -> list[dict[str, Any]]:
        """The measured curves: `file`, `points`, `depth_zero` in m, `force_zero` in N and the line of forces
        `before_contact` of each; None for what is taken as exact or not there."""
        curves: list[dict[str, Any]] = self._found["curves"]
        return curves

    @property
    def excluded(self) -> Curve | None:
        """The points at which the model is not valid, with reasons; None if there are none."""
        table = self._tables.get("excluded.csv")
        return None if table is None else Curve.of_csv(table)

    def plot(self) -> Any:
        """Plots data, model and residuals; returns the matplotlib figure."""
        return fit_views.curve(self.curve, f"{self.fit.title}: {self.verdict}")

    def plot_profiles(self) -> Any:
        """Plots the likelihood along each unknown with its interval; returns the matplotlib figure."""
        return fit_views.profiles(self.unknowns, self.profiles)

    def __str__(self) -> str:
        return "\n".join([f"{self.fit.title}: {self.verdict}", *(f"  {estimate}" for estimate in self.unknowns)])

    def __repr__(self) -> str:
        return f"<Identification {self.fit.title!r}: {len(self.unknowns)} unknown, {self.verdict}>"

    def _repr_html_(self) -> str:
        header = ["key", "value", "interval", "verdict", "why"]
        return show.table(header, [fit_views.cells(estimate) for estimate in self.unknowns])


class EachCurve(Result):
    """What every curve of a fit gives alone."""

    @property
    def curves(self) -> list[dict[str, Any]]:
        """The curves in their order: `file`, `position`, `verdict` (`"failed"` for one that could not be fitted),
        `unknowns`, `misfit_p`, the `cause` of a failure or misfit, and the `warnings` of its fit."""
        curves: list[dict[str, Any]] = self._found["curves"]
        return curves

    @cached_property
    def warnings(self) -> list[ResultWarning]:
        """Warnings about the curves, in their order."""
        return [ResultWarning(**warning) for curve in self.curves for warning in curve["warnings"]]

    @cached_property
    def table(self) -> Curve:
        """The columns of `each.csv`, a row for each curve."""
        return Curve.of_csv(self._tables["each.csv"])

    @property
    def _rows(self) -> list[list[str]]:
        return [
            [curve["file"], curve["verdict"], *(str(estimate_of(found)) for found in curve["unknowns"])]
            for curve in self.curves
        ]

    def __str__(self) -> str:
        return "\n".join([self.fit.title, *(f"  {': '.join(cells)}" for cells in self._rows)])

    def __repr__(self) -> str:
        fitted = sum(curve["verdict"] == "fitted" for curve in self.curves)
        return f"<EachCurve {self.fit.title!r}: {fitted} of {len(self.curves)} fitted>"

    def _repr_html_(self) -> str:
        return show.table(["file", "verdict", "unknowns"], ([*row[:2], ", ".join(row[2:])] for row in self._rows))


class Plan(Result):
    """The expected accuracy of designs, before anything is measured."""

    @cached_property
    def designs(self) -> list[ExpectedDesign]:
        """The designs, best first."""
        return [design_of(found) for found in self._found["designs"]]

    @cached_property
    def table(self) -> Curve:
        """The columns of `plan.csv`."""
        return Curve.of_csv(self._tables["plan.csv"])

    def __str__(self) -> str:
        return "\n".join([f"{self.fit.title}: expected", *(f"  {' '.join(cells)}" for cells in self._rows)])

    @property
    def _rows(self) -> list[list[str]]:
        return [fit_views.design_cells(design) for design in self.designs]

    def __repr__(self) -> str:
        return f"<Plan {self.fit.title!r}: {len(self.designs)} designs>"

    def _repr_html_(self) -> str:
        keys = [expected.key for expected in self.designs[0].unknowns] if self.designs else []
        return show.table(["curves", *keys], self._rows)


def identify(
    fit: Fit | str | os.PathLike[str], *, progress: bool | FitReport = False, threads: int | None = None
) -> Identification:
    """Carries out a fit, or that of a fit file, as `pellicle identify` does.

    `progress` shows a bar, or is a function that receives a `FitProgress` a few times a second. `threads` is as for
    `Case.solve`; any number gives the same bits. Ctrl-C raises `Interrupted`, whose `result` holds the best values and
    the intervals found so far. A misfit or an unconverged fit is returned with a `FitWarning`.
    """
    fit = fit_of(fit)
    run = fit.begun(is_measured=True).start_fit(checked_threads(threads))
    return finished(run, lambda found: _identification(fit, found), reporting(progress, fit, FitProgress))


def identify_each(
    fit: Fit | str | os.PathLike[str], *, progress: bool | FitReport = False, threads: int | None = None
) -> EachCurve:
    """Fits every curve alone, as `pellicle identify --each` does: a force volume, or repeats of a measurement.

    A curve that fails stops no other; its `cause` says why. Arguments are those of `identify`.
    """
    fit = fit_of(fit)
    run = fit.begun(is_measured=True).start_each(checked_threads(threads))
    return finished(run, lambda found: EachCurve(*_parts(fit, found)), reporting(progress, fit, FitProgress))


def plan(fit: Fit | str | os.PathLike[str], *, progress: bool | FitReport = False, threads: int | None = None) -> Plan:
    """Predicts the accuracy of designs, as `pellicle identify --plan` does; no data are needed."""
    fit = fit_of(fit)
    run = fit.begun(is_measured=fit.is_measured).start_plan(checked_threads(threads))
    return finished(run, lambda found: Plan(*_parts(fit, found)), reporting(progress, fit, FitProgress))


def fit_of(fit: Fit | str | os.PathLike[str]) -> Fit:
    """The fit, or that of a fit file."""
    if isinstance(fit, Fit):
        return fit
    if isinstance(fit, (str, os.PathLike)):
        return Fit.from_toml(fit)
    raise ArgumentError(f"fit: found {type(fit).__name__}, wanted a pellicle.Fit or the path of a fit file")


def _parts(fit: Fit, found: Files) -> tuple[Fit, dict[str, Any], dict[str, str], bool]:
    text, tables, is_whole = found
    return fit, json.loads(text), dict(tables), is_whole


def _identification(fit: Fit, found: Files) -> Identification:
    """Makes the result of a fit; warns if it is finished but should not be used."""
    made = Identification(*_parts(fit, found))
    if not made.is_whole:
        return made
    if made.verdict == "misfit":
        message = "misfit: the model does not fit the measurements; do not use these numbers"
        warnings.warn(FitWarning(message, made.verdict), stacklevel=4)
    elif made.verdict != "fitted":
        message = f"{made.verdict}: do not use these numbers"
        warnings.warn(FitWarning(message, made.verdict), stacklevel=4)
    return made


def _timeless(found: Mapping[str, Any]) -> dict[str, Any]:
    """A result without the time it took."""
    work = {name: value for name, value in found["work"].items() if name != "seconds"}
    return {**found, "work": work}
