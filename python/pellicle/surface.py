"""The surfaces of a case: springs on the body, or its own roughness."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, Literal, TypeAlias

from .height_map import HeightMap
from .quantity import Quantity
from .table import Table

Law: TypeAlias = Literal["linear", "logarithmic"]
"""How springs shorten: in proportion to the pressure, or never beyond their length."""


@dataclass(frozen=True)
class Surface(Table):
    """The surface of the body: bare, or with springs or roughness."""

    _part: ClassVar[str | None] = "surface"


@dataclass(frozen=True)
class Bare(Surface):
    """The bare, plane surface of the body."""

    _kind: ClassVar[str] = "bare"


@dataclass(frozen=True)
class Cylinders(Surface):
    """Elastic cylinders of equal radius and height on a lattice of this period, all in m.

    `offset` shifts the axis of one cylinder from that of the indenter, in m. The Young's modulus (Pa) defaults
    to that of the top layer.
    """

    _kind: ClassVar[str] = "cylinders"
    radius: Quantity
    height: Quantity
    period: Quantity
    lattice: Literal["square", "hexagonal"] | None = None
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
