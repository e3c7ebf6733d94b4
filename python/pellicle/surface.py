"""The surfaces of a case: springs on the body, or its own roughness."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, Literal, TypeAlias

from .height_map import HeightMap
from .quantity import Quantity
from .table import Table

Law: TypeAlias = Literal["linear", "logarithmic"]
"""How springs shorten: in proportion to the pressure, or never beyond their length."""

Lattice: TypeAlias = Literal["square", "hexagonal"]
"""Where equal round features stand: with four or with six neighbours each."""


@dataclass(frozen=True)
class Surface(Table):
    """The surface of the body: bare, or with springs or roughness."""

    _part: ClassVar[str | None] = "surface"


@dataclass(frozen=True)
class Bare(Surface):
    """The bare, plane surface of the body."""

    _kind: ClassVar[str] = "bare"


@dataclass(frozen=True)
class Pattern(Surface):
    """Equal features in a pattern, which has a period or an `area_fraction`.

    `offset` shifts one of them from the indenter's axis, `rotation` (radians) turns the pattern about it, and
    `edge_radius` rounds the edges.
    """

    area_fraction: float | None = field(default=None, kw_only=True)
    rotation: Quantity | None = field(default=None, kw_only=True)
    edge_radius: Quantity | None = field(default=None, kw_only=True)


@dataclass(frozen=True)
class Cylinders(Pattern):
    """Elastic cylinders of equal radius and height on a lattice, all lengths in m.

    The `area_fraction` is that of their tops. The Young's modulus (Pa) defaults to that of the top layer.
    """

    _kind: ClassVar[str] = "cylinders"
    radius: Quantity
    height: Quantity
    period: Quantity | None = None
    lattice: Lattice | None = None
    offset: tuple[Quantity, Quantity] | None = None
    young_modulus: Quantity | None = None
    law: Law | None = None


@dataclass(frozen=True)
class Dimples(Pattern):
    """Dimples on a lattice: spherical caps below the plane, with the radius of the rim and the depth in m.

    The `area_fraction` is what the rims enclose. Without a Young's modulus (Pa) they are in the body's own surface,
    with one they lie between springs, each as long as the height above the deepest point.
    """

    _kind: ClassVar[str] = "dimples"
    radius: Quantity
    depth: Quantity
    period: Quantity | None = None
    lattice: Lattice | None = None
    offset: tuple[Quantity, Quantity] | None = None
    young_modulus: Quantity | None = None
    law: Law | None = None


@dataclass(frozen=True)
class Grooves(Pattern):
    """Straight grooves below the plane, with their width and depth in m.

    The `area_fraction` is their width over the period. They run along y until they are turned. Without a Young's
    modulus (Pa) they are in the body's own surface, with one they lie between springs, each as long as the height above
    the deepest point.
    """

    _kind: ClassVar[str] = "grooves"
    width: Quantity
    depth: Quantity
    period: Quantity | None = None
    profile: Literal["rectangular", "v", "sine"] | None = None
    offset: tuple[Quantity, Quantity] | None = None
    young_modulus: Quantity | None = None
    law: Law | None = None


@dataclass(frozen=True)
class Film(Surface):
    """A film of springs that covers the whole surface: its thickness in m and its Young's modulus in Pa."""

    _kind: ClassVar[str] = "film"
    thickness: Quantity
    young_modulus: Quantity
    law: Law | None = None


@dataclass(frozen=True, eq=False)
class Rough(HeightMap, Surface):
    """The body's own rough surface."""

    _kind: ClassVar[str] = "rough"


@dataclass(frozen=True, eq=False)
class ReliefMap(HeightMap, Surface):
    """A measured relief of springs: their compliance in m/Pa, 0 if rigid, or their Young's modulus in Pa."""

    _kind: ClassVar[str] = "map"
    compliance: Quantity | None = field(default=None, kw_only=True)
    young_modulus: Quantity | None = field(default=None, kw_only=True)
    law: Law | None = field(default=None, kw_only=True)
