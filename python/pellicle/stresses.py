"""Displacements and stresses on planes in the body."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ._pellicle import Planes

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, eq=False)
class StressFields(Mapping[str, npt.NDArray[np.float64]]):
    """Fields by name, each an array over plane, x and y: stresses in Pa, tension positive, and displacements in m.

    `ux`, `uy`, `uz`, `sxx`, `syy`, `szz`, `sxy`, `sxz`, `syz`, `von_mises` and `max_principal`.
    """

    depth: npt.NDArray[np.float64]
    """Depths of the planes, m, from the surface down; an interface has two, above and below it."""
    body: tuple[str, ...]
    """The body of each plane, such as `"layer[0]"` or `"substrate"`."""
    x: npt.NDArray[np.float64]
    """Coordinates along x, which are those along y, m."""
    fields: dict[str, npt.NDArray[np.float64]]
    """The arrays."""
    about: dict[str, tuple[str, str]]
    """Unit and meaning of each field."""

    @classmethod
    def of(cls, planes: Planes) -> StressFields:
        """The fields of computed planes."""
        found = planes.fields()
        return cls(
            planes.depths(),
            tuple(planes.bodies()),
            planes.centres(),
            {name: values for name, (_, _, values) in found.items()},
            {name: (unit, meaning) for name, (unit, meaning, _) in found.items()},
        )

    @property
    def y(self) -> npt.NDArray[np.float64]:
        """Coordinates along y, m."""
        return self.x

    def __getitem__(self, name: str) -> npt.NDArray[np.float64]:
        return self.fields[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.fields)

    def __len__(self) -> int:
        return len(self.fields)

    def to_xarray(self) -> xarray.Dataset:
        """The fields as an `xarray.Dataset` over plane, x and y; needs xarray."""
        import xarray

        dimensions = ("plane", "x", "y")
        fields = {
            name: (dimensions, values, {"units": self.about[name][0], "long_name": self.about[name][1]})
            for name, values in self.items()
        }
        planes = {"depth": ("plane", self.depth, {"units": "m"}), "body": ("plane", list(self.body))}
        return xarray.Dataset(fields, planes | {"x": ("x", self.x), "y": ("y", self.x)})

    def __repr__(self) -> str:
        shape = " × ".join(map(str, (self.depth.size, self.x.size, self.x.size)))
        return f"<StressFields: {', '.join(self)} on {shape} points>"
