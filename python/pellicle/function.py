"""Shapes given by functions, evaluated at the centres of the elements without a map in between."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar, TypeAlias

import numpy as np
import numpy.typing as npt

from .errors import ArgumentError
from .given import array
from .indenter import Indenter
from .quantity import Quantity
from .surface import Surface
from .table import Table

Coordinates: TypeAlias = npt.NDArray[np.float64]
"""One coordinate of each of n points, m: an array of shape (n,)."""

Function: TypeAlias = Callable[[Coordinates, Coordinates], npt.ArrayLike]
"""A function of x and of y (m), two arrays of float64 of shape (n,), that gives n real numbers."""


@dataclass(frozen=True)
class IndenterFunction(Indenter):
    """An indenter given by a function: its height (m) at points x and y (m), +inf where it ends.

    The height is measured above the plane z = 0, the origin of the penetration. The points are the centres of the
    elements of each grid, and some others where a side is chosen or checked.
    """

    _kind: ClassVar[str] = "function"
    _hidden: ClassVar[frozenset[str]] = frozenset({"function"})
    function: Function

    def __post_init__(self) -> None:
        self._take()
        _check(self.function, "function")

    def functions(self) -> dict[str, CheckedFunction]:
        """The function by its name, with checks."""
        return {"indenter": CheckedFunction(self.function, "indenter", highest=np.inf)}


@dataclass(frozen=True)
class ReliefFunction(Surface):
    """A relief given by a function: its profile (m) at points x and y (m), best 0 on the tops and negative elsewhere.

    `compliance` is the compliance of its linear springs in m/Pa: a function or a quantity, 0 for a relief that does not
    shorten.
    """

    _kind: ClassVar[str] = "function"
    _hidden: ClassVar[frozenset[str]] = frozenset({"profile"})
    profile: Function
    compliance: Quantity | Function = field(default=0.0, kw_only=True)

    def __post_init__(self) -> None:
        if not callable(self.compliance):
            self._take()
        _check(self.profile, "profile")

    def as_table(self) -> dict[str, Any]:
        """The keys of the relief without its functions."""
        return {"kind": self._kind} if callable(self.compliance) else super().as_table()

    def functions(self) -> dict[str, CheckedFunction]:
        """The functions by their names, with checks."""
        found = {"profile": CheckedFunction(self.profile, "profile")}
        if callable(self.compliance):
            found["compliance"] = CheckedFunction(self.compliance, "compliance", lowest=0.0, unit="m/Pa")
        return found


@dataclass(frozen=True)
class CheckedFunction:
    """A function whose values are checked; the error of a wrong value names the function."""

    function: Function
    name: str
    lowest: float = -np.finfo(np.float64).max
    highest: float = np.finfo(np.float64).max
    unit: str = "m"

    def __call__(self, x: Coordinates, y: Coordinates, is_estimate: bool) -> npt.NDArray[np.float64]:
        # An overflow is refused or marks an end; estimates evaluate far points, where the function may have ended.
        with np.errstate(all="ignore" if is_estimate else None, over="ignore", under="ignore"):
            given = self.function(x.copy(), y.copy())
        shape = np.shape(given)
        if shape != x.shape:
            raise ArgumentError(f"{self.name}: found values of shape {shape}, wanted {x.shape}, that of x and y")
        values = array(self.name, given, self.unit, holes=is_estimate)
        if is_estimate:
            return np.where(np.isnan(values), np.inf, values)
        is_wrong = ~((values >= self.lowest) & (values <= self.highest))
        if is_wrong.any():
            i = int(is_wrong.argmax())
            raise ArgumentError(f"{self.name}: found {values[i]} at ({x[i]}, {y[i]}), wanted {self._wanted()}")
        return values

    def _wanted(self) -> str:
        if self.lowest == 0.0:
            return "a finite number of zero or more"
        return "a number or +inf" if self.highest == np.inf else "a finite number"


def as_part(value: Any, kind: type[Table], of_function: Callable[[Function], Table]) -> Any:
    """The part of a case; a bare function is converted to one."""
    is_function = callable(value) and not isinstance(value, (kind, type))
    return of_function(value) if is_function else value


def _check(function: Any, name: str) -> None:
    if not callable(function) or isinstance(function, type):
        raise ArgumentError(f"{name}: found {function!r}, wanted a function of x and y")
