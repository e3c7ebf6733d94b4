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
from .given import array, has_unit, integer, taken
from .quantity import Quantity, number
from .table import Table

Heights: TypeAlias = npt.ArrayLike | str | os.PathLike[str]
"""A 2-D array of heights, first index along x, second along y; or the path of a file that holds one."""


MOST_SAMPLES = 16384
"""The largest number of samples along a side of a map of a function: more points than elements tell nothing."""

Height: TypeAlias = Callable[[npt.NDArray[np.float64], npt.NDArray[np.float64]], npt.ArrayLike]
"""A function of arrays of x and of y (m) that gives heights (m)."""


@dataclass(frozen=True, eq=False)
class HeightMap(Table):
    """A height map.

    `heights` is an array, first index along x and second along y, or the path of a file (.npy, .csv, .txt, .gsf).
    `side` is the length of the map along x in m, for square pixels; `sides` are its lengths along x and y. A file may
    contain them. `height_unit` is the length represented by 1 in the array, in m unless it has a unit; an array of a
    units library has its own. `lateral_unit` is that of x and y in a file of points x, y, z, or of a size without a
    unit. Where heights are missing, or a number such as -9999 stands for them, the map is refused, or with
    `holes="interpolate"` each is the mean of its neighbours; with `holes="none"` every number is a height. In an array
    the missing ones are NaN, infinite or masked. `level="plane"` subtracts the least-squares plane, and `edges="taper"`
    makes opposite edges fit in a periodic cell.
    """

    _apart: ClassVar[frozenset[str]] = frozenset({"heights"})
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
        self._take()
        heights = self.heights
        if isinstance(heights, (str, os.PathLike)):
            return
        if has_unit(heights):
            if self.height_unit not in (None, "1 m"):
                found = f"{self.height_unit!r} beside heights with a unit"
                raise ArgumentError(f"height_unit: found {found}, wanted one of them")
            object.__setattr__(self, "height_unit", "1 m")
        may_have_holes = self.holes == "interpolate"
        object.__setattr__(self, "heights", checked("heights", heights, "m", may_have_holes=may_have_holes))

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        mine, others = vars(self) | {"heights": None}, vars(other) | {"heights": None}
        return mine == others and is_same(self.heights, other.heights)

    __hash__: ClassVar[None]  # type: ignore[assignment]

    @classmethod
    def sampled(
        cls, function: Height, samples: int | tuple[int, int], *, sides: tuple[Quantity, Quantity], **keys: Any
    ) -> Self:
        """Samples a function of x and y (m), which is called once with two arrays and returns heights (m).

        The map has `samples` samples along each side, at the centres of its pixels, and heights between them are
        interpolated. The centre of the map lies at x = y = 0.
        """
        given, lengths = taken("samples", samples), taken("sides", sides)
        counts = given if isinstance(given, tuple) else (given, given)
        for name, pair in (("samples", counts), ("sides", lengths)):
            if not isinstance(pair, tuple) or len(pair) != 2:
                raise ArgumentError(f"{name}: found {pair!r}, wanted two, along x and y")
        x, y = np.meshgrid(*(_centres(*axis) for axis in zip(counts, lengths, strict=True)), indexing="ij")
        found = function(x, y)
        if np.shape(found) != x.shape:
            raise ArgumentError(f"function: found values of shape {np.shape(found)}, wanted {x.shape}, that of x and y")
        holes = keys.get("holes") == "interpolate"
        return cls(checked("function", found, "m", may_have_holes=holes), sides=lengths, **keys)

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


def checked(name: str, values: Any, unit: str, *, may_have_holes: bool | None = None) -> npt.NDArray[np.float64]:
    """A read-only copy of an array in this unit, with two axes and finite numbers.

    Where there may be holes, they are NaN, and so are masked values; None stands for an array that is no map.
    """
    is_map = may_have_holes is not None
    found = array(name, values, unit, holes=is_map)
    if found.ndim != 2 or found.size == 0:
        raise ArgumentError(f"{name}: found an array of shape {found.shape}, wanted two dimensions, not empty")
    missing = ~np.isfinite(found)
    if missing.any() and not may_have_holes:
        i, j = np.argwhere(missing)[0]
        count = f"{missing.sum()} of {found.size} heights missing, the first" if is_map else found[i, j]
        wanted = 'every height, or holes="interpolate"' if is_map else "finite numbers"
        raise ArgumentError(f"{name}: found {count} at [{i}, {j}], wanted {wanted}")
    found.flags.writeable = False
    return found


def is_same(one: Heights, other: Heights) -> bool:
    """Whether two paths or two arrays are equal; holes are."""
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return np.array_equal(one, other, equal_nan=True)
    return type(one) is type(other) and one == other


def _centres(count: Any, side: Quantity) -> npt.NDArray[np.float64]:
    """The centres of pixels along a side."""
    pixels = integer("samples", count, 1, MOST_SAMPLES)
    centres: npt.NDArray[np.float64] = number("sides", side, "m") * ((np.arange(pixels) + 0.5) / pixels - 0.5)
    return centres
