"""Height maps: arrays, or files named by the case."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal, Self, TypeAlias

import numpy as np
import numpy.typing as npt

from . import toml
from .errors import ArgumentError
from .quantity import Quantity
from .table import Table

Heights: TypeAlias = npt.ArrayLike | str | os.PathLike[str]
"""A 2-D array of heights, first index along x, second along y; or the path of a file that holds one."""


Height: TypeAlias = Callable[[npt.NDArray[np.float64], npt.NDArray[np.float64]], npt.ArrayLike]
"""A function of arrays of x and of y (m) that gives heights (m)."""


@dataclass(frozen=True, eq=False)
class HeightMap(Table):
    """A height map.

    `heights` is an array, first index along x and second along y, or the path of a file (.npy, .csv, .txt, .gsf).
    `side` is the length of the map along x in m, for square pixels; `sides` are its lengths along x and y. A file may
    contain them. `height_unit` is the length represented by 1 in the array, in m unless it has a unit, and
    `lateral_unit` that of x and y in a file of points x, y, z, or of a size without a unit. Where heights are missing, or
    a number such as -9999 stands for them, the map is refused, or with `holes="interpolate"` each is the mean of its
    neighbours; with `holes="none"` every number is a height. `level="plane"` subtracts the least-squares plane, and
    `edges="taper"` makes opposite edges fit in a periodic cell.
    """

    heights: Heights
    side: Quantity | None = field(default=None, kw_only=True)
    sides: tuple[Quantity, Quantity] | None = field(default=None, kw_only=True)
    height_unit: Quantity | None = field(default=None, kw_only=True)
    interpolation: Literal["bicubic", "linear"] | None = field(default=None, kw_only=True)
    holes: Literal["refuse", "interpolate", "none"] | None = field(default=None, kw_only=True)
    level: Literal["plane", "none"] | None = field(default=None, kw_only=True)
    edges: Literal["as measured", "taper"] | None = field(default=None, kw_only=True)
    lateral_unit: Quantity | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        if not isinstance(self.heights, (str, os.PathLike)):
            object.__setattr__(self, "heights", checked(self.heights, "heights"))

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        mine, others = vars(self), vars(other)
        return all(np.array_equal(mine[name], others[name]) for name in mine)

    __hash__: ClassVar[None]  # type: ignore[assignment]

    @classmethod
    def sampled(
        cls, function: Height, samples: int | tuple[int, int], *, sides: tuple[float, float], **keys: Any
    ) -> Self:
        """Samples a function of x and y (m), which is called once with two arrays and returns heights (m).

        The map has `samples` samples along each side, at the centres of its pixels, and heights between them are
        interpolated. The centre of the map lies at x = y = 0.
        """
        counts = (samples, samples) if isinstance(samples, int) else samples
        axes = [side * ((np.arange(count) + 0.5) / count - 0.5) for count, side in zip(counts, sides, strict=True)]
        x, y = np.meshgrid(*axes, indexing="ij")
        found = np.asarray(function(x, y))
        if found.shape != x.shape:
            raise ArgumentError(f"function: found values of shape {found.shape}, wanted {x.shape}, that of x and y")
        return cls(checked(found, "function"), sides=sides, **keys)

    def as_table(self) -> dict[str, toml.Value]:
        """The keys of the map without its file."""
        table = super().as_table()
        del table["heights"]
        return table

    def file_or_array(self, name: str) -> tuple[str, npt.NDArray[np.float64] | None]:
        """The path of the map's file, or a name for its array and the array."""
        if isinstance(self.heights, np.ndarray):
            return name, self.heights
        return os.path.abspath(os.fspath(self.heights)), None  # type: ignore[arg-type]


def checked(values: Any, name: str) -> npt.NDArray[np.float64]:
    """Returns a read-only copy of an array, checked to have two dimensions and finite real numbers."""
    array = np.asarray(values)
    if array.ndim != 2 or array.size == 0:
        raise ArgumentError(f"{name}: found an array of shape {array.shape}, wanted two dimensions, not empty")
    if array.dtype.kind not in "fiu":
        raise ArgumentError(f"{name}: found an array of {array.dtype}, wanted real numbers")
    copied = np.array(array, dtype=np.float64, order="C")
    if not np.isfinite(copied).all():
        i, j = np.argwhere(~np.isfinite(copied))[0]
        raise ArgumentError(f"{name}: found {copied[i, j]} at [{i}, {j}], wanted finite numbers")
    copied.flags.writeable = False
    return copied
