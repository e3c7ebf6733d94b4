"""Further tables of a case: ranges of loads, stresses, and output."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from .quantity import Quantity
from .table import Table


@dataclass(frozen=True)
class Range(Table):
    """`count` values from `start` to `stop`, evenly spaced or, with `"log"`, in equal ratios."""

    _names: ClassVar[Mapping[str, str]] = {"start": "from", "stop": "to"}

    start: Quantity
    stop: Quantity
    count: int
    spacing: Literal["linear", "log"] = "linear"


Distances: TypeAlias = Sequence[Quantity] | npt.NDArray[np.float64] | Range
"""Several sliding distances: a list, an array or a range."""


Depths: TypeAlias = Sequence[Quantity] | npt.NDArray[np.float64] | Range
"""Several depths: a list, an array or a range."""


StressName: TypeAlias = Literal[
    "max_von_mises",
    "max_principal",
    "min_principal",
    "max_shear",
    "max_shear_traction",
    "max_tension",
    "max_compression",
]
"""A largest stress by its name in the summary: four of bodies, three of interfaces."""


@dataclass(frozen=True)
class Stress(Table):
    """Requests the stresses inside the body.

    The program writes planes at `depths`, squares of side `extent`, in m. A sliding indenter has a coefficient of
    `friction` and a `direction` in rad, from +x to +y. `only` names the stresses whose largest values are sought, as in
    the summary; by default all. With `body="indenter"` they are those inside an elastic indenter, at depths measured
    into it; with `body="both"` the largest values are those of each body, and the planes are in the foundation.
    """

    _part: ClassVar[str] = "stress"
    depths: Depths | None = None
    extent: Quantity | None = None
    friction: float | None = None
    direction: Quantity | None = None
    only: Sequence[StressName] | None = None
    body: Literal["foundation", "indenter", "both"] | None = None


@dataclass(frozen=True)
class Wear(Table):
    """Wears the surface over a sliding distance: depth = coefficient × pressure × distance, everywhere.

    The `coefficient` is in m²/N; exactly one of `distance` and `distances` (m) is given, and each distance is a step.
    `tolerance` is the error of the depths in each step over the largest depth.
    """

    _part: ClassVar[str] = "wear"
    _units: ClassVar[Mapping[str, str]] = {"coefficient": "m^2/N"}
    coefficient: Quantity
    distance: Quantity | None = None
    distances: Distances | None = None
    tolerance: float | None = None


@dataclass(frozen=True)
class Output(Table):
    """What `pellicle run` writes for this case, which has no effect in Python, and a length in m.

    `mean_pressure_over` is the diameter of a disc over which the pressure is averaged: the largest average of each
    step is its `max_averaged_pressure`.
    """

    _part: ClassVar[str] = "output"
    fields: Literal["all", "last", "none"] | None = None
    pictures: Literal["all", "last", "none"] | None = None
    formats: Sequence[Literal["npz", "vti", "nc", "gsf"]] | None = None
    mean_pressure_over: Quantity | None = None
