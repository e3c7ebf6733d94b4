"""The certificate, the warnings and the cost of a solution."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


def number(value: float | None) -> float:
    """A number of a summary, in which null stands for a non-finite value."""
    return math.nan if value is None else float(value)


@dataclass(frozen=True, slots=True)
class Certificate:
    """How well a pressure satisfies the contact conditions, computed afresh from it. True if they are satisfied.

    All lines but `min_pressure` and `over_limit` (Pa) are dimensionless.
    """

    complementarity: float
    """Σ p |g| / (D Σ p)."""
    gap_in_contact: float
    """Largest |g| / D where p > 0."""
    overlap: float
    """How far the bodies overlap: max(0, −min g) / D."""
    load: float
    """|4a² Σ p − Q| / Q; 0 where the penetration is prescribed."""
    min_pressure: float
    """Smallest pressure, Pa."""
    worst: float
    """The largest of the dimensionless lines."""
    satisfied: bool
    """Whether every line keeps to the tolerance and no pressure is negative or above the hardness."""
    gap_at_limit: float = 0.0
    """max(0, g) / D where the pressure is at the hardness; 0 without one."""
    over_limit: float = 0.0
    """By how much the largest pressure exceeds the hardness, Pa."""

    def __bool__(self) -> bool:
        return self.satisfied

    @classmethod
    def of(cls, summary: Mapping[str, Any]) -> Certificate:
        """The certificate in a summary."""
        satisfied: bool = summary["satisfied"]
        return cls(**{key: number(value) for key, value in summary.items() if key != "satisfied"}, satisfied=satisfied)


@dataclass(frozen=True, slots=True)
class Estimate:
    """The grid error of one number, in its unit, with its order of convergence and whether the number is resolved."""

    estimate: float
    order: float | None
    resolved: bool

    @classmethod
    def of(cls, summary: Mapping[str, Any] | None) -> Estimate | None:
        """The estimate in a summary, if there is one."""
        if summary is None:
            return None
        return cls(number(summary["estimate"]), summary["order"], summary["resolved"])


@dataclass(frozen=True, slots=True)
class GridError:
    """The distance of a step's numbers from those of an infinitely fine grid, estimated from coarser grids."""

    penetration: Estimate | None
    force: Estimate | None
    contact_area: Estimate | None
    max_pressure: Estimate | None
    levels: tuple[Mapping[str, float | None], ...]
    """The numbers on each grid, coarsest first."""
    elements_per_wave: float | None = None
    """Elements to the shortest wave of a measured map around the contact; below 5 nothing is resolved."""
    max_averaged_pressure: Estimate | None = None
    """That of the largest averaged pressure; none without `mean_pressure_over`."""

    @classmethod
    def of(cls, summary: Mapping[str, Any]) -> GridError:
        """The grid error in a summary."""
        return cls(
            penetration=Estimate.of(summary.get("penetration")),
            force=Estimate.of(summary.get("force")),
            contact_area=Estimate.of(summary.get("contact_area")),
            max_pressure=Estimate.of(summary.get("max_pressure")),
            levels=tuple(summary["levels"]),
            elements_per_wave=summary.get("elements_per_wave"),
            max_averaged_pressure=Estimate.of(summary.get("max_averaged_pressure")),
        )


@dataclass(frozen=True, slots=True)
class Work:
    """The work of a step: iterations and operator products on the finest grid, and seconds."""

    iterations: int
    operator_applications: int
    seconds: float
    levels: tuple[Mapping[str, int], ...]
    """The work on each coarser grid."""

    @classmethod
    def of(cls, summary: Mapping[str, Any]) -> Work:
        """The work in a summary."""
        return cls(
            summary["iterations"],
            summary["operator_applications"],
            number(summary["seconds"]),
            tuple(summary["levels"]),
        )


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """The derivatives of a step with respect to one number θ of the case, per unit of θ; None if undefined."""

    value: float
    """θ itself."""
    penetration: float | None
    """∂D/∂θ at constant force, of the elements in contact."""
    smooth_penetration: float | None
    """The same along the curve, without the steps of elements that enter the contact."""
    force: float | None
    """∂Q/∂θ at constant penetration, of the elements in contact."""
    energy: float
    """∂E/∂θ at constant force, E = ∫ D dQ."""

    @classmethod
    def of(cls, summary: Mapping[str, Any]) -> Sensitivity:
        """The derivatives in a summary."""
        return cls(
            value=number(summary["value"]),
            penetration=summary["penetration"],
            smooth_penetration=summary["smooth_penetration"],
            force=summary["force"],
            energy=number(summary["energy"]),
        )


@dataclass(frozen=True, slots=True)
class ResultWarning:
    """A doubt about a result: a code for programs and a sentence for people."""

    code: str
    message: str

    def __str__(self) -> str:
        return self.message
