"""Quantities: numbers in SI units, strings with units, and quantities of a units library such as pint."""

from __future__ import annotations

import numbers
from typing import Any, Protocol, TypeAlias

from ._pellicle import key_units
from .errors import ArgumentError


class UnitQuantity(Protocol):
    """A quantity of a units library: pint's, astropy's or unyt's."""

    def to(self, unit: str, /) -> Any:
        """Converts the quantity to another unit."""
        ...


Quantity: TypeAlias = float | str | UnitQuantity
"""A number in SI units, a string such as `"5 nm"`, or a quantity of a units library."""

SI_UNITS = key_units() | {
    "depth": "m",
    "radii": "m",
    "spring_constant": "N/m",
    "frame_compliance": "m/N",
    "baseline": "m",
    "depth_zero": "m",
    "force_zero": "N",
    "drift": "m/s",
    "tip_radius": "m",
}
"""The SI unit of every key of a case or a fit that is a quantity."""


def written(value: object, name: str, unit: str) -> float | int | str:
    """The quantity as written in a case file: a number, or a string with a unit."""
    if isinstance(value, str):
        return value
    if isinstance(value, numbers.Integral) and not isinstance(value, bool):
        return int(value)
    if isinstance(value, numbers.Real) and not isinstance(value, bool):
        return float(value)
    if hasattr(value, "to"):
        return _of_library(value, name, unit)
    found = type(value).__name__
    wanted = "a number in SI units, a string with a unit or a quantity of a units library"
    raise ArgumentError(f"{name}: found {found}, wanted {wanted}")


def _of_library(value: Any, name: str, unit: str) -> float | str:
    """The value of a library's quantity in this unit, with the unit."""
    try:
        converted = value.to(unit)
        number = float(getattr(converted, "magnitude", getattr(converted, "value", converted)))
    except Exception as error:
        raise ArgumentError(f"{name}: found {value}, wanted a quantity in {unit} ({error})") from error
    return number if unit == "dimensionless" else f"{number!r} {unit}"
