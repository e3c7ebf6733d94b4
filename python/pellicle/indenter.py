"""The indenters of a case. Each may be elastic: give both `young_modulus` in Pa and `poisson_ratio`, or a `body`."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from .body import Foundation
from .height_map import HeightMap
from .quantity import Quantity
from .table import Table


@dataclass(frozen=True)
class Indenter(Table):
    """An indenter, rigid unless it has a Young's modulus (Pa) and a Poisson's ratio, or a `body` with layers."""

    _part: ClassVar[str | None] = "indenter"
    young_modulus: Quantity | None = field(default=None, kw_only=True)
    poisson_ratio: float | None = field(default=None, kw_only=True)
    body: Foundation | None = field(default=None, kw_only=True)


@dataclass(frozen=True)
class Paraboloid(Indenter):
    """A paraboloid of revolution of height ρ²/(2R), with R the radius of curvature in m, or, with `radii` in its place,
    of height x²/(2Rx) + y²/(2Ry)."""

    _kind: ClassVar[str] = "paraboloid"
    radius: Quantity | None = None
    radii: tuple[Quantity, Quantity] | None = None


@dataclass(frozen=True)
class Sphere(Indenter):
    """A ball of this radius in m."""

    _kind: ClassVar[str] = "sphere"
    radius: Quantity


@dataclass(frozen=True)
class Cone(Indenter):
    """A cone: the angle between its axis and its side in rad, and the radius of its tip in m, 0 if it is sharp."""

    _kind: ClassVar[str] = "cone"
    half_angle: Quantity
    tip_radius: Quantity | None = None


@dataclass(frozen=True)
class Pyramid(Indenter):
    """A pyramid: the radius of its tip in m, 0 if it is sharp, and the angle between its axis and a face in rad."""

    tip_radius: Quantity | None = None
    face_angle: Quantity | None = None


@dataclass(frozen=True)
class Berkovich(Pyramid):
    """A three-sided pyramid, with faces at 65.03° to the axis by default."""

    _kind: ClassVar[str] = "berkovich"


@dataclass(frozen=True)
class Vickers(Pyramid):
    """A four-sided pyramid, with faces at 68° to the axis by default."""

    _kind: ClassVar[str] = "vickers"


@dataclass(frozen=True)
class CubeCorner(Pyramid):
    """The corner of a cube, with faces at 35.26° to the axis by default."""

    _kind: ClassVar[str] = "cube-corner"


@dataclass(frozen=True)
class PowerLaw(Indenter):
    """A body of revolution of height ρⁿ/cⁿ⁻¹: the exponent n from 1 to 50, and the coefficient c in m.

    With n = 2 it is a paraboloid of radius c/2, with n = 1 a cone of slope 1 whatever c is.
    """

    _kind: ClassVar[str] = "power"
    exponent: float
    coefficient: Quantity


@dataclass(frozen=True)
class FlatPunch(Indenter):
    """The flat end of a cylinder of this radius in m."""

    _kind: ClassVar[str] = "flat-punch"
    radius: Quantity


@dataclass(frozen=True)
class Flat(Indenter):
    """A plane without end, pressed on a rough or textured body."""

    _kind: ClassVar[str] = "flat"


@dataclass(frozen=True, eq=False)
class IndenterMap(HeightMap, Indenter):
    """A measured indenter: heights of its surface above the plane; the lowest point touches first.

    The lowest point lies on the axis, or with `origin="as given"` the middle of the map, so that it stays in register
    with a surface's map. Where the map ends the indenter does.
    """

    _kind: ClassVar[str] = "map"
    origin: Literal["summit", "as given"] | None = field(default=None, kw_only=True)
