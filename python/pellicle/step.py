"""One loading step of a path: its numbers, its fields, and how reliable they are."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
import numpy.typing as npt

from . import show, toml
from ._pellicle import number_text
from .errors import ArgumentError
from .fields import Field, Fields, StoredFields
from .judgement import Certificate, GridError, ResultWarning, Sensitivity, Work, number
from .numbers import FIELDS, StepNumbers
from .options import Depths, Stress
from .quantity import Quantity
from .stresses import StressFields

if TYPE_CHECKING:
    import xarray


class Step(StepNumbers):
    """A loading step. Numbers are in SI units or the case's own, fields are N × N arrays, first index along x."""

    def __init__(
        self, summary: Mapping[str, Any], grid: Mapping[str, Any], index: int, fields: Fields, is_si: bool
    ) -> None:
        self._summary = summary
        self._grid = grid
        self._fields = fields
        self.is_si = is_si
        """Whether numbers are in SI units; otherwise in the case's own."""
        self.index = index
        """The step, counted from 0."""

    @property
    def summary(self) -> Mapping[str, Any]:
        """The step as in `summary.json`."""
        return self._summary

    @property
    def area_at_limit(self) -> float:
        """Area of the elements at the hardness, m²; 0 without a hardness."""
        return number(self._summary.get("area_at_limit", 0.0))

    @property
    def fraction_at_limit(self) -> float:
        """Area of the elements at the hardness over the contact area."""
        return number(self._summary.get("fraction_at_limit", 0.0))

    @property
    def rough_contact(self) -> Mapping[str, Any] | None:
        """Islands, mean gap, and histograms of pressures and gaps, as in `summary.json`; None without a map."""
        rough: Mapping[str, Any] | None = self._summary.get("rough_contact")
        return rough

    @property
    def status(self) -> Literal["certified", "cut-off", "beyond-model", "not-converged"]:
        """Whether the step may be used; only `"certified"` is good."""
        status: Literal["certified", "cut-off", "beyond-model", "not-converged"] = self._summary["status"]
        return status

    @cached_property
    def certificate(self) -> Certificate:
        """How well the contact conditions are satisfied; false if they are not."""
        return Certificate.of(self._summary["certificate"])

    @cached_property
    def grid_error(self) -> GridError:
        """The distance of the numbers from those of an infinitely fine grid."""
        return GridError.of(self._summary["grid_error"])

    @cached_property
    def work(self) -> Work:
        """The work of the solution."""
        return Work.of(self._summary["work"])

    @cached_property
    def warnings(self) -> list[ResultWarning]:
        """The warnings about this step; those about the whole path are in `path.warnings`."""
        return self._fields.warnings_of(self.index)

    @cached_property
    def pressure(self) -> Field:
        """Pressure p, Pa, compression positive: a read-only array in the memory of the solution."""
        return self._fields.pressure(self.index)

    @property
    def displacement(self) -> Field:
        """Displacement u of the body's surface, m, positive into the body."""
        return self._surface[0]

    @property
    def gap(self) -> Field:
        """Gap g between indenter and surface, m; infinite where the indenter has no surface."""
        return self._surface[1]

    @property
    def shortening(self) -> Field:
        """Shortening w* of the relief, m."""
        return self._surface[2]

    @property
    def plastic_depth(self) -> Field:
        """Plastic depth −g where the pressure is at the hardness, m; 0 elsewhere."""
        if self.area_at_limit == 0.0:
            return np.zeros_like(self.pressure)
        # The elements at the hardness are those with exactly the largest pressure.
        is_cut = self.pressure >= self.pressure.max()
        return np.where(is_cut, np.maximum(-self.gap, 0.0), 0.0)

    @property
    def profile(self) -> Field:
        """Profile f* of the relief, m: 0 on the tops, negative between them."""
        return self._geometry[0]

    @property
    def mask(self) -> npt.NDArray[np.bool_]:
        """Whether an element belongs to the relief."""
        return self._geometry[1]

    @property
    def contact(self) -> npt.NDArray[np.bool_]:
        """Whether an element carries pressure."""
        return self.pressure > 0.0

    @cached_property
    def x(self) -> npt.NDArray[np.float64]:
        """Coordinates of the element centres along x, m; the axis is at 0."""
        return self._centres(0)

    @cached_property
    def y(self) -> npt.NDArray[np.float64]:
        """Coordinates of the element centres along y, m."""
        return self._centres(1)

    def _centres(self, axis: int) -> npt.NDArray[np.float64]:
        size = self._grid.get("lengths", [self._grid["elements"]] * 2)[axis]
        coordinates: npt.NDArray[np.float64] = (2 * np.arange(size) + 1 - size) * (0.5 * self._grid["element_side"])
        return coordinates

    @cached_property
    def _surface(self) -> tuple[Field, Field, Field]:
        return self._fields.surface(self.index)

    @cached_property
    def _geometry(self) -> tuple[Field, npt.NDArray[np.bool_]]:
        return self._fields.geometry()

    def sensitivities(self) -> dict[str, Sensitivity]:
        """The derivatives of the step with respect to numbers of the case, by key; the case must have requested
        them."""
        given = self._summary.get("sensitivities")
        if given is None:
            raise ArgumentError("sensitivities: found none, wanted Case(..., sensitivities=True)")
        return {one["parameter"]: Sensitivity.of(one) for one in given}

    def stress(
        self,
        depths: Depths | None = None,
        *,
        extent: Quantity | None = None,
        friction: float | None = None,
        direction: Quantity | None = None,
    ) -> StressFields:
        """Displacements and stresses on planes at these depths (m) in the body; by default down to two contact radii.

        The planes are squares of side `extent` (m), by default 1.5 contact diameters. A sliding indenter has a
        coefficient of `friction` and a `direction` (rad) from +x to +y.
        """
        table = Stress(depths, extent, friction, direction).as_table()
        return StressFields.of(self._fields.stress(self.index, toml.text({"stress": table})))

    def to_xarray(self) -> xarray.Dataset:
        """The fields as an `xarray.Dataset` over x and y, with units and meanings; needs xarray."""
        import xarray

        def attributes(unit: str | None, meaning: str) -> dict[str, str]:
            return {"long_name": meaning} | ({} if unit is None else {"units": unit if self.is_si else "case units"})

        has_hardness = self._summary.get("area_at_limit") is not None
        given = {name: about for name, about in FIELDS.items() if has_hardness or name != "plastic_depth"}
        fields = {name: (("x", "y"), getattr(self, name), attributes(*about)) for name, about in given.items()}
        axes = {
            axis: (axis, getattr(self, axis), attributes("m", f"{axis} of the element's centre")) for axis in ("x", "y")
        }
        values = {"force": self.force, "penetration": self.penetration, "status": self.status}
        return xarray.Dataset(fields, axes, values)

    def plot(self, ax: Any = None) -> Any:
        """Draws the pressure with matplotlib on `ax` or on new axes, and returns the axes."""
        import matplotlib.pyplot as plt
        from matplotlib.ticker import EngFormatter, MaxNLocator

        ax = plt.subplots()[1] if ax is None else ax
        x, y = (0.5 * axis.size * self._grid["element_side"] for axis in (self.x, self.y))
        image = ax.imshow(self.pressure.T, origin="lower", extent=(-x, x, -y, y), cmap="viridis")
        bar = ax.figure.colorbar(image, ax=ax, label="pressure")
        force, penetration = self._quantity(self.force, "N"), self._quantity(self.penetration, "m")
        ax.set(xlabel="x", ylabel="y", title=f"Q = {force}, D = {penetration}")
        if self.is_si:
            for axis, unit in ((ax.xaxis, "m"), (ax.yaxis, "m"), (bar.ax.yaxis, "Pa")):
                axis.set_major_formatter(EngFormatter(unit))
            # Numbers with units are wide.
            ax.xaxis.set_major_locator(MaxNLocator(4))
        return ax

    def _quantity(self, value: float, unit: str) -> str:
        """A number with a prefix and its unit, if the step is in SI units."""
        return number_text(value, unit, self.is_si)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Step):
            return NotImplemented
        mine, others = (self.force, self.penetration), (other.force, other.penetration)
        return mine == others and np.array_equal(self.pressure, other.pressure)

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> Step:
        return self

    def __deepcopy__(self, memo: object) -> Step:
        return self

    def __reduce__(self) -> tuple[type[Step], tuple[Any, ...]]:
        steps, radii = range(self.index, self.index + 1), {self.index: self.contact_radius}
        stored = StoredFields.of(self._fields, steps, self._grid["side"], radii)
        return Step, (self._summary, self._grid, self.index, stored, self.is_si)

    def __repr__(self) -> str:
        force, penetration = self._quantity(self.force, "N"), self._quantity(self.penetration, "m")
        return f"<Step {self.index}: Q = {force}, D = {penetration}, {self.status}>"

    def _repr_html_(self) -> str:
        return show.table([f"step {self.index}", ""], main_numbers(self))


def main_numbers(step: Step) -> list[tuple[str, str]]:
    """The main numbers of a step, as rows of a table."""
    return [
        ("force", step._quantity(step.force, "N")),
        ("penetration", step._quantity(step.penetration, "m")),
        ("max pressure", step._quantity(step.max_pressure, "Pa")),
        ("contact area", step._quantity(step.contact_area, "m^2")),
        ("certificate", f"{step.certificate.worst:.1e}"),
        ("status", step.status),
    ]
