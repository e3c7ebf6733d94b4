"""Quantities: numbers in SI units, strings with units, and quantities of a units library such as pint."""

from __future__ import annotations

import numbers
from typing import Any, Protocol, TypeAlias

from ._pellicle import key_unit, key_units, si_value
from .errors import ArgumentError


class UnitQuantity(Protocol):
    """A quantity of a units library: pint's, astropy's or unyt's."""

    def to(self, unit: str, /) -> Any:
        """Converts the quantity to another unit."""
        ...


Quantity: TypeAlias = float | str | UnitQuantity
"""A number in SI units, a string such as `"5 nm"`, or a quantity of a units library."""

SI_UNITS = key_units() | {
    "angle": "rad",
    "depth": "m",
    "radii": "m",
    "spring_constant": "N/m",
    "stiffness": "N/m",
    "frame_compliance": "m/N",
    "baseline": "m",
    "depth_zero": "m",
    "force_zero": "N",
    "shift": "m",
    "drift": "m/s",
    "tip_radius": "m",
}
"""The SI unit of every key of a case or a fit that is a quantity."""


def unit_of(path: str) -> str | None:
    """The SI unit of the key at a path such as `foundation.layer[0].thickness`; None if it is no quantity."""
    names = [word for word in words(path) if not word.isdecimal()]
    return key_unit(words(path)) or SI_UNITS.get(names[-1] if names else path)


def with_units(value: Any, path: str = "") -> Any:
    """The value of a case at this path; bare numbers in it have the SI unit of their keys."""
    if isinstance(value, dict):
        return {key: with_units(item, f"{path}.{key}" if path else key) for key, item in value.items()}
    if isinstance(value, list):
        return [with_units(item, f"{path}[{i}]") for i, item in enumerate(value)]
    if isinstance(value, (str, bool)):
        return value
    unit = key_unit(words(path))
    return value if unit is None else f"{value!r} {unit}"


def words(path: str) -> list[str]:
    """The keys and indices of a path such as `foundation.layer[0].thickness`."""
    return path.replace("[", ".").replace("]", "").split(".")


def written(value: object, name: str, unit: str) -> float | int | str:
    """The quantity as written in a case file: a number, or a string with a unit."""
    if isinstance(value, str):
        return value
    if isinstance(value, numbers.Integral) and not isinstance(value, bool):
        return int(value)
    if isinstance(value, numbers.Real) and not isinstance(value, bool):
        return float(value)
    if hasattr(value, "to"):
        found = float(in_unit(name, value, unit))
        return found if unit == "dimensionless" else f"{found!r} {unit}"
    kind = type(value).__name__
    wanted = "a number in SI units, a string with a unit or a quantity of a units library"
    raise ArgumentError(f"{name}: found {kind}, wanted {wanted}")


def number(name: str, value: object, unit: str) -> float:
    """The number of SI units in a quantity."""
    if not isinstance(value, str):
        return float(in_unit(name, value, unit) if hasattr(value, "to") else written(value, name, unit))
    try:
        return si_value(value, unit)
    except ValueError as error:
        wanted = f"a number, or a quantity in {unit}"
        raise ArgumentError(f"{name}: found {value!r} ({error}), wanted {wanted}") from error


def in_unit(name: str, value: Any, unit: str) -> Any:
    """The number, or the array of them, of a library's quantity in this unit."""
    try:
        converted = value.to(unit)
        found = getattr(converted, "magnitude", getattr(converted, "value", converted))
        return found if getattr(found, "ndim", 0) else float(found)
    except Exception as error:
        raise ArgumentError(f"{name}: found {_shown(value)}, wanted a quantity in {unit} ({error})") from error


def _shown(value: Any) -> str:
    """The quantity itself, or of several their unit."""
    return f"values in {getattr(value, 'units', getattr(value, 'unit', '?'))}" if getattr(value, "ndim", 0) else str(value)
