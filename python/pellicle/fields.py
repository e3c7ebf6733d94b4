"""The sources of a path's fields: the solution itself, or stored arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, TypeAlias

import numpy as np
import numpy.typing as npt

from ._pellicle import Foundation, Planes, Solution
from .errors import ArgumentError
from .judgement import ResultWarning

Field: TypeAlias = npt.NDArray[np.float64]
"""N × N numbers, first index along x."""


class Fields(Protocol):
    """The fields of the steps of a path."""

    @property
    def foundation(self) -> str:
        """The table of the body in the case."""
        ...

    def pressure(self, step: int) -> Field:
        """Pressure, Pa."""
        ...

    def surface(self, step: int) -> tuple[Field, Field, Field]:
        """Displacement, gap and shortening, m."""
        ...

    def geometry(self) -> tuple[Field, npt.NDArray[np.bool_]]:
        """Profile of the relief, m, and whether an element belongs to it."""
        ...

    def warnings_of(self, step: int) -> list[ResultWarning]:
        """The warnings about this step."""
        ...

    def report(self) -> str:
        """The page of the run as HTML."""
        ...

    def stress(self, step: int, text: str) -> Planes:
        """Displacements and stresses on the planes requested by a table `[stress]`."""
        ...


@dataclass(frozen=True, slots=True)
class SolvedFields:
    """The fields of a solution: its own pressure in place, the others computed from it."""

    solution: Solution
    foundation: str
    """The table of the body in the case."""

    def pressure(self, step: int) -> Field:
        """Pressure, Pa; read-only."""
        return np.asarray(self.solution.pressure(step))

    def surface(self, step: int) -> tuple[Field, Field, Field]:
        """Displacement, gap and shortening, m."""
        displacement, gap, shortening = self.solution.surface(step)
        return displacement, gap, shortening

    def geometry(self) -> tuple[Field, npt.NDArray[np.bool_]]:
        """Profile of the relief, m, and whether an element belongs to it."""
        return self.solution.geometry()

    def warnings_of(self, step: int) -> list[ResultWarning]:
        """The warnings about this step."""
        return [ResultWarning(*warning) for warning in self.solution.warnings_of(step)]

    def report(self) -> str:
        """The page of the run as HTML."""
        return self.solution.report()

    def stress(self, step: int, text: str) -> Planes:
        """Displacements and stresses on the planes requested by a table `[stress]`."""
        return self.solution.stress(step, text)


@dataclass(frozen=True, slots=True)
class StoredFields:
    """Stored fields of some steps of a path, as kept in a pickle."""

    foundation: str
    """The table of the body in the case."""
    side: float
    """Side of the grid, m."""
    radii: dict[int, float]
    """Contact radii, m."""
    pressures: dict[int, Field]
    surfaces: dict[int, tuple[Field, Field, Field]]
    relief: tuple[Field, npt.NDArray[np.bool_]]
    warnings: dict[int, list[ResultWarning]]

    @classmethod
    def of(cls, fields: Fields, steps: range, side: float, radii: dict[int, float]) -> StoredFields:
        """Computes and stores the fields of these steps, on a grid of this side, with these contact radii."""
        return cls(
            fields.foundation,
            side,
            radii,
            {step: np.array(fields.pressure(step)) for step in steps},
            {step: fields.surface(step) for step in steps},
            fields.geometry(),
            {step: fields.warnings_of(step) for step in steps},
        )

    def pressure(self, step: int) -> Field:
        """Pressure, Pa; read-only."""
        pressure = self.pressures[step].view()
        pressure.flags.writeable = False
        return pressure

    def surface(self, step: int) -> tuple[Field, Field, Field]:
        """Displacement, gap and shortening, m."""
        return self.surfaces[step]

    def geometry(self) -> tuple[Field, npt.NDArray[np.bool_]]:
        """Profile of the relief, m, and whether an element belongs to it."""
        return self.relief

    def warnings_of(self, step: int) -> list[ResultWarning]:
        """The warnings about this step."""
        return self.warnings[step]

    def report(self) -> str:
        """Refused: the solution itself is needed."""
        raise ArgumentError("report: found a path from a pickle, wanted one that was solved here")

    def stress(self, step: int, text: str) -> Planes:
        """Displacements and stresses on the planes requested by a table `[stress]`."""
        foundation = Foundation(self.foundation, "case")
        return foundation.stress(self.pressures[step], self.side, self.radii[step], text)
