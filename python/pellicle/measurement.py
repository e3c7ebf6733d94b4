"""The measurements of a fit: instrument files or arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np
import numpy.typing as npt

from .errors import ArgumentError
from .given import array
from .quantity import Quantity
from .table import Table

UNITS = {
    "depth": "m",
    "force": "N",
    "time": "s",
    "stiffness": "N/m",
    "contact_radius": "m",
    "height": "m",
    "deflection": "m",
}
"""The columns that are quantities, with the SI unit in which arrays hold them."""

Observe = Literal[
    "depth at force",
    "force at depth",
    "stiffness at depth",
    "stiffness at force",
    "stiffness at contact radius",
    "unloading",
]
"""The quantity that is compared with the model, and at which values of another; of an unloading its stiffness."""


@dataclass(frozen=True)
class Text(Table):
    """The text format of a file."""

    decimal: Literal[".", ","] | None = None
    separator: Literal["auto", ",", ";", "tab", "space"] | None = None
    skip_until: str | None = None
    table: int | None = None
    encoding: str | None = None
    invalid_above: float | None = None


@dataclass(frozen=True)
class Segment(Table):
    """The part of a curve that is used.

    `start` and `stop` are forces (`"0.8 mN"`), times (`"3 s"`), row numbers from 1, or tables such as `{"force": 1e-3}`
    and `{"marker": "hold"}`.
    """

    _names: ClassVar[Mapping[str, str]] = {"start": "from", "stop": "to"}

    start: str | int | Mapping[str, Any] | None = None
    stop: str | int | Mapping[str, Any] | None = None
    part: Literal["loading", "unloading", "whole"] | None = None
    until: Literal["largest force", "largest depth step"] | None = None
    value: str | int | float | None = None


@dataclass(frozen=True)
class Noise(Table):
    """Standard deviations of the measured values: in m, in N, in N/m, and as a fraction of the observed value."""

    depth: Quantity | None = None
    force: Quantity | None = None
    stiffness: Quantity | None = None
    relative: float | None = None
    correlation: Literal["none", "estimate"] | None = None


@dataclass(frozen=True)
class Uncertain(Table):
    """A value and its standard deviation, in SI units."""

    mean: Quantity
    sd: Quantity | None = None


@dataclass(frozen=True)
class Baseline(Table):
    """A stretch between two distances before the contact, in m, whose line of forces is subtracted."""

    _names: ClassVar[Mapping[str, str]] = {"start": "from", "stop": "to"}

    start: Quantity
    stop: Quantity


@dataclass(frozen=True)
class SpringConstant(Uncertain):
    """The spring constant of a cantilever and its standard deviation, in N/m."""


@dataclass(frozen=True)
class Data(Table):
    """Measured curves: a file, or a pattern for several, and how to read them. `Data.of_arrays` takes arrays."""

    file: str
    columns: Mapping[str, int | str]
    units: Mapping[str, str | float] | None = None
    text: Text | None = None
    segment: Segment | None = None
    baseline: Literal["before contact", "off"] | Baseline | None = None
    observe: Observe | None = None
    noise: Noise | None = None
    spring_constant: Quantity | SpringConstant | None = None
    height_direction: Literal["toward", "away", "auto"] | None = None
    set: Mapping[str, Any] | None = None
    omit: Sequence[int] | Mapping[str, Sequence[int]] | None = None
    """Rows to leave out, from 1; for several files, by the name of each."""

    _measured: ClassVar[str | None] = None

    @classmethod
    def of_arrays(
        cls,
        *,
        depth: npt.ArrayLike | None = None,
        force: npt.ArrayLike | None = None,
        time: npt.ArrayLike | None = None,
        stiffness: npt.ArrayLike | None = None,
        contact_radius: npt.ArrayLike | None = None,
        height: npt.ArrayLike | None = None,
        deflection: npt.ArrayLike | None = None,
        segment: Segment | None = None,
        baseline: Literal["before contact", "off"] | Baseline | None = None,
        observe: Observe | None = None,
        noise: Noise | None = None,
        spring_constant: Quantity | SpringConstant | None = None,
        height_direction: Literal["toward", "away", "auto"] | None = None,
        set: Mapping[str, Any] | None = None,
        omit: Sequence[int] | None = None,
        name: str | None = None,
    ) -> Data:
        """One curve, as arrays of equal length in the order of the measurement: in SI units, or of a units library.

        The result refers to it by `name`. A stiffness in N/m is observed at a force, a depth or a contact
        radius √(A/π), see `observe`.
        """
        given = {
            "depth": depth,
            "force": force,
            "time": time,
            "stiffness": stiffness,
            "contact_radius": contact_radius,
            "height": height,
            "deflection": deflection,
        }
        arrays = {key: _column(key, values) for key, values in given.items() if values is not None}
        return MeasuredArrays(
            file="" if name is None else name,
            columns={key: key for key in arrays},
            units={key: UNITS[key] for key in arrays},
            segment=segment,
            baseline=baseline,
            observe=observe,
            noise=noise,
            spring_constant=spring_constant,
            height_direction=height_direction,
            set=set,
            omit=omit,
            rows=_rows(arrays),
        )

    def rows_or_none(self) -> str | None:
        """The text of the arrays; None if a file is read."""
        return None


@dataclass(frozen=True)
class MeasuredArrays(Data):
    """A curve of arrays, written as text for the program with enough digits to restore the same bits."""

    _hidden: ClassVar[frozenset[str]] = frozenset({"rows"})

    rows: str = ""

    def rows_or_none(self) -> str | None:
        """The text of arrays."""
        return self.rows

    def __repr__(self) -> str:
        points = max(self.rows.count("\n") - 1, 0)
        return f"<Data of {', '.join(self.columns) or 'nothing'}: {points} points>"


def _column(name: str, values: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Converts a column to numbers along one axis, or raises an error."""
    column = array(name, values, UNITS[name])
    if column.ndim != 1:
        raise ArgumentError(f"{name}: found an array of shape {column.shape}, wanted one axis")
    wrong = np.flatnonzero(~np.isfinite(column))
    if wrong.size:
        raise ArgumentError(f"{name}: found {column[wrong[0]]} at [{wrong[0]}], wanted finite numbers")
    return column


def _rows(arrays: Mapping[str, npt.NDArray[np.float64]]) -> str:
    """The columns as text, each number with enough digits to be restored exactly."""
    sizes = {name: column.size for name, column in arrays.items()}
    first = next(iter(sizes.values()), 0)
    for name, size in sizes.items():
        if size != first:
            raise ArgumentError(f"{name}: found {size} values, wanted {first}, as many as of {next(iter(sizes))}")
    columns = [column.tolist() for column in arrays.values()]
    lines = [",".join(arrays), *(",".join(map(repr, row)) for row in zip(*columns, strict=True))]
    return "\n".join(lines) + "\n"
