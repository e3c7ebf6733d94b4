"""The numbers and fields of a step. Made from the declarations in `pellicle/src/result`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .judgement import number

FIELDS: dict[str, tuple[str | None, str]] = {
    "pressure": ("Pa", "pressure p, compression positive"),
    "displacement": ("m", "displacement u of the body's surface, positive into the body"),
    "gap": ("m", "gap g between the indenter and the surface"),
    "shortening": ("m", "shortening w* of the relief"),
    "profile": ("m", "profile f* of the relief: 0 on the unworn tops, negative between them and where it is worn"),
    "plastic_depth": ("m", "plastic depth where the pressure is cut at the hardness"),
    "mask": (None, "whether the element belongs to the relief"),
    "contact": (None, "whether the element carries pressure"),
}
"""Unit and meaning of each field."""


class StepNumbers:
    """The numbers of a loading step."""

    _summary: Mapping[str, Any]

    @property
    def force(self) -> float:
        """Force on the indenter, or on one periodic cell, N."""
        return number(self._summary["force"])

    @property
    def penetration(self) -> float:
        """Depth of the indenter's lowest point below the highest point of the undeformed surface, m."""
        return number(self._summary["penetration"])

    @property
    def max_pressure(self) -> float:
        """Largest pressure, interpolated between elements where it is smooth, at an edge that of the element, Pa."""
        return number(self._summary["max_pressure"])

    @property
    def max_pressure_at(self) -> tuple[float, float]:
        """Where the pressure is largest, the first of several equal places, m."""
        return (number(self._summary["max_pressure_at"][0]), number(self._summary["max_pressure_at"][1]))

    @property
    def max_averaged_pressure(self) -> float | None:
        """Largest pressure averaged over a disc as wide as mean_pressure_over, Pa; None if not given."""
        return None if self._summary.get("max_averaged_pressure") is None else number(self._summary["max_averaged_pressure"])

    @property
    def mean_pressure(self) -> float:
        """Force over contact area, never above the largest pressure; 0 without contact, Pa."""
        return number(self._summary["mean_pressure"])

    @property
    def nominal_pressure(self) -> float | None:
        """Force over a periodic cell, or over the nominal area of a measured surface, Pa; None if not given."""
        return None if self._summary.get("nominal_pressure") is None else number(self._summary["nominal_pressure"])

    @property
    def contact_area(self) -> float:
        """True contact area, its edge located within an element by pressure and gap, m²."""
        return number(self._summary["contact_area"])

    @property
    def contact_area_on_relief(self) -> float:
        """Contact area on the tops of the relief, m²."""
        return number(self._summary["contact_area_on_relief"])

    @property
    def contact_area_between(self) -> float:
        """Contact area between the tops of the relief, m²."""
        return number(self._summary["contact_area_between"])

    @property
    def contact_radius(self) -> float:
        """Distance from the axis to the farthest point of the contact's edge; 0 without contact, m."""
        return number(self._summary["contact_radius"])

    @property
    def contact_elements(self) -> int:
        """Elements that carry pressure."""
        return int(self._summary["contact_elements"])

    @property
    def contact_stiffness(self) -> float | None:
        """Change of the force with the penetration, for the elements in contact, N/m; None if not given."""
        return None if self._summary.get("contact_stiffness") is None else number(self._summary["contact_stiffness"])

    @property
    def area_at_limit(self) -> float | None:
        """Area of the elements whose pressure is cut at the hardness, m²; None if not given."""
        return None if self._summary.get("area_at_limit") is None else number(self._summary["area_at_limit"])

    @property
    def fraction_at_limit(self) -> float | None:
        """This area over the contact area; 0 without contact; None if not given."""
        return None if self._summary.get("fraction_at_limit") is None else number(self._summary["fraction_at_limit"])
