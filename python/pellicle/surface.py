"""The surfaces of a case: the springs that the body carries, or its own roughness."""

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


@dataclass(frozen=True)
class Bare(Surface):
    """The plane surface of the body itself."""

    _kind: ClassVar[str] = "bare"


@dataclass(frozen=True)
class Cylinders(Surface):
    """Elastic cylinders of one radius and height on a lattice of this period, all in m.

    `offset` moves an axis away from the indenter's, in m. Without a Young's modulus (Pa) it is that of the top layer.
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
    """A film of springs that covers everything: its thickness in m and its Young's modulus in Pa."""

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
