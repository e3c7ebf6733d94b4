"""Estimates found by fits or expected by plans, with intervals, verdicts and known combinations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .judgement import number

Interval = tuple[float, float]
"""Two ends; infinite on a side that is open."""


@dataclass(frozen=True)
class KnownCombination:
    """A product of powers of the unknowns that the data determine."""

    expression: str
    value: float
    """In SI units."""
    interval: Interval


@dataclass(frozen=True)
class FitEstimate:
    """The estimate of a number, in SI units."""

    key: str
    unit: str
    value: float
    interval: Interval
    level: float
    """Level of the interval."""
    wald: Interval
    """The interval from the covariance alone."""
    verdict: str
    """`"identified"`, `"weak"`, `"one-sided"`, `"not-identified"`, `"not-identifiable"` or `"prior-driven"`."""
    why: str
    """Why, in a sentence."""
    scatter: float | None
    """Standard deviation between repeats; None without repeats."""
    known_combination: KnownCombination | None
    """The combination that is known if the number is not identifiable."""

    def __str__(self) -> str:
        low, high = (f"{end:.4g}" if np.isfinite(end) else "open" for end in self.interval)
        return f"{self.key} = {self.value:.4g} {self.unit}   [{low}, {high}]   {self.verdict}"


@dataclass(frozen=True)
class Expected:
    """The expected estimate of a number, in SI units."""

    key: str
    unit: str
    value: float
    """The value assumed true."""
    standard_error: float
    """Of its logarithm, the relative one where it is small; NaN where the data do not determine it."""
    factor: float
    """The factor within which the interval lies, as if there were no bounds; infinite where the data give none."""
    interval: Interval
    verdict: str
    known_combination: KnownCombination | None


@dataclass(frozen=True)
class ExpectedDesign:
    """One or several curves, and the accuracy to expect from them."""

    curves: Sequence[Mapping[str, Any]]
    """The curves to measure."""
    unknowns: Sequence[Expected]
    nuisances: Sequence[Expected]


def _interval(ends: Sequence[float | None]) -> Interval:
    low, high = ends
    return -np.inf if low is None else low, np.inf if high is None else high


def _combination(found: Mapping[str, Any] | None) -> KnownCombination | None:
    if found is None:
        return None
    return KnownCombination(found["expression"], found["value"], _interval(found["interval"]))


def estimate_of(found: Mapping[str, Any]) -> FitEstimate:
    """Converts an estimate from its form in `fit.json`."""
    changed = {
        "interval": _interval(found["interval"]),
        "wald": _interval(found["wald"]),
        "scatter": found.get("scatter"),
        "known_combination": _combination(found["known_combination"]),
    }
    return FitEstimate(**{**found, **changed})


def design_of(found: Mapping[str, Any]) -> ExpectedDesign:
    """Converts a design from its form in `plan.json`."""
    unknowns, nuisances = (list(map(_expected, found[name])) for name in ("unknowns", "nuisances"))
    return ExpectedDesign(found["curves"], unknowns, nuisances)


def _expected(found: Mapping[str, Any]) -> Expected:
    changed = {
        "interval": _interval(found["interval"]),
        "standard_error": number(found["standard_error"]),
        "factor": np.inf if found["factor"] is None else found["factor"],
        "known_combination": _combination(found["known_combination"]),
    }
    return Expected(**{**found, **changed})
