"""What callers give, taken once: numbers and arrays in SI units, and sequences as tuples."""

from __future__ import annotations

import numbers
import os
from collections.abc import Iterable, Mapping, Set
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from .errors import ArgumentError
from .quantity import in_unit, number

Part = TypeVar("Part")


def taken(name: str, value: Any) -> Any:
    """The value of an argument that no caller can change later.

    A list, an array, a generator or anything else with items becomes a tuple, an array without axes the number in it.
    """
    if isinstance(value, np.generic):
        value = value.item()
    if value is None or isinstance(value, (str, bytes, numbers.Number, os.PathLike)) or _is_quantity(value):
        return value
    if isinstance(value, Mapping):
        return {key: taken(f"{name}.{key}", item) for key, item in value.items()}
    if isinstance(value, Set):
        raise ArgumentError(f"{name}: found a {type(value).__name__}, which has no order, wanted a list")
    axes = _axes(value)
    if axes is not None:
        _without_mask(name, value)
        if axes == 0:
            return value if hasattr(value, "to") else np.asarray(value).item()
        value = value if _has_unit(value) else np.asarray(value).tolist()
    elif not isinstance(value, Iterable) or isinstance(value, type):
        return value
    return tuple(taken(f"{name}[{i}]", item) for i, item in enumerate(value))


def array(name: str, values: Any, unit: str, *, holes: bool = False) -> npt.NDArray[np.float64]:
    """A new array of the values in this unit, in the order of C.

    Values with a unit are converted, others are in it. Masked values become NaN where there may be holes, and are
    refused elsewhere.
    """
    found = _plain(name, values, unit, holes)
    if found.dtype.kind == "O":
        items = [number(f"{name}[{i}]", item, unit) for i, item in enumerate(found.flat)]
        found = np.array(items, dtype=np.float64).reshape(found.shape)
    if found.dtype.kind not in "fiu":
        raise ArgumentError(f"{name}: found values of {found.dtype}, wanted real numbers")
    return np.array(found, dtype=np.float64, order="C")


def has_unit(values: Any) -> bool:
    """Whether an array, or the first item of a list, has its own unit."""
    while isinstance(values, (list, tuple)) and values:
        values = values[0]
    return isinstance(values, str) or _is_quantity(values) or _has_unit(values)


def switch(name: str, value: Any, or_else: str = "") -> bool:
    """A truth value; `or_else` are other values that are wanted."""
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise ArgumentError(f"{name}: found {value!r}, wanted True or False{or_else}")


def integer(name: str, value: Any, least: int, most: int) -> int:
    """A whole number in a range."""
    is_whole = isinstance(value, numbers.Integral) and not isinstance(value, bool)
    if not is_whole or not least <= int(value) <= most:
        raise ArgumentError(f"{name}: found {value!r}, wanted an integer from {least} to {most}")
    return int(value)


def part(name: str, value: Any, kind: type[Part]) -> Part:
    """A value of this class of the package."""
    if not isinstance(value, kind):
        raise ArgumentError(f"{name}: found {type(value).__name__}, wanted a pellicle.{kind.__name__}")
    return value


def parts(name: str, values: Any, kind: type[Part]) -> tuple[Part, ...]:
    """Several values of this class, or one."""
    given = taken(name, values)
    if isinstance(given, kind):
        return (given,)
    if not isinstance(given, tuple):
        raise ArgumentError(f"{name}: found {type(values).__name__}, wanted a list of pellicle.{kind.__name__}")
    return tuple(part(f"{name}[{i}]", item, kind) for i, item in enumerate(given))


def mapping(name: str, value: Any, wanted: str) -> Mapping[str, Any]:
    """A dict by strings."""
    if not isinstance(value, Mapping) or not all(isinstance(key, str) for key in value):
        raise ArgumentError(f"{name}: found {type(value).__name__}, wanted {wanted}")
    return value


def _plain(name: str, values: Any, unit: str, holes: bool) -> npt.NDArray[Any]:
    """The values in this unit without it, as NumPy has them."""
    if _has_unit(values):
        values = in_unit(name, values, unit)
    elif isinstance(values, str) or _is_quantity(values):
        values = number(name, values, unit)
    elif _axes(values) is None and isinstance(values, Iterable) and not isinstance(values, (bytes, Mapping, Set)):
        items = [item if type(item) is float else _plain(name, item, unit, holes) for item in values]
        try:
            values = np.array(items) if items else np.zeros(0)
        except ValueError as error:
            raise ArgumentError(f"{name}: found rows of different lengths, wanted equal ones") from error
    if not holes:
        _without_mask(name, values)
    elif isinstance(values, np.ma.MaskedArray) and values.dtype.kind in "fiu":
        return np.where(np.ma.getmaskarray(values), np.nan, np.ma.getdata(values))
    return np.asarray(values)


def _axes(value: Any) -> int | None:
    """How many axes an array has; None if it is none."""
    axes = getattr(value, "ndim", None)
    return axes if isinstance(axes, int) else None


def _has_unit(value: Any) -> bool:
    """Whether this is an array of a units library; arrays of other libraries have `to` as well."""
    return _axes(value) is not None and hasattr(value, "to") and (hasattr(value, "units") or hasattr(value, "unit"))


def _is_quantity(value: Any) -> bool:
    """Whether this is a single quantity of a units library."""
    return hasattr(value, "to") and _axes(value) is None


def _without_mask(name: str, value: Any) -> None:
    """Refuses masked values, for which there is no number."""
    inner = getattr(value, "magnitude", value)
    if isinstance(inner, np.ma.MaskedArray) and np.ma.is_masked(inner):
        masked, all_of = int(np.ma.getmaskarray(inner).sum()), inner.size
        found = f"a masked array with {masked} of {all_of} values masked" if inner.ndim else "a masked value"
        raise ArgumentError(f"{name}: found {found}, wanted a number everywhere: leave masked values out")
