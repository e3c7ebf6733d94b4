"""How unloadings are evaluated by Oliver and Pharr: the table `[evaluation]` of a fit file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from . import toml
from .body import Material
from .measurement import Uncertain
from .quantity import Quantity, written
from .table import Table


@dataclass(frozen=True)
class KnownBody(Table):
    """The body of known Young's modulus (Pa) with which an indenter is calibrated, and the number of coefficients of
    the area function that is sought."""

    young_modulus: Quantity
    coefficients: int | None = None


@dataclass(frozen=True)
class OliverPharr(Table):
    """How unloadings are evaluated; defaults are those of ISO 14577 with a tip of diamond.

    The indenter is an `area_function`, either coefficients such as `[24.5, "120 nm"]`, numbers being in powers of m, or
    the file of a calibration, or a `tip` with its `tip_radius`, or it is sought by `calibrate`.
    """

    poisson_ratio: float | Uncertain
    """Poisson's ratio of the body."""
    area_function: Sequence[Quantity] | str | None = None
    tip: Literal["berkovich", "vickers", "cube corner", "cone", "sphere"] | None = None
    tip_radius: Quantity | None = None
    angle: Quantity | None = None
    """The angle between axis and side of a cone, rad."""
    beta: float | Uncertain | None = None
    epsilon: float | Literal["exponent"] | Uncertain | None = None
    unloading: tuple[float, float] | None = None
    """The upper and the lower end of the fitted part, over the largest force."""
    frame_compliance: Quantity | Uncertain | None = None
    """m/N."""
    drift: Literal["hold", "off"] | Quantity | Uncertain | None = None
    """A rate in m/s, or where it comes from."""
    depth_zero: Literal["first contact", "as recorded"] | Quantity | Uncertain | None = None
    """A depth of the file in m, or where the contact begins."""
    indenter: Material | Literal["rigid"] | None = None
    """The material of the tip."""
    thinning: float | None = None
    """The part of the contact depth by which an imprint thins the top layer."""
    calibrate: KnownBody | None = None

    def as_table(self) -> dict[str, toml.Value]:
        """The keys of `[evaluation]`; coefficients have their units."""
        table = super().as_table()
        if isinstance(self.area_function, tuple):
            table["area_function"] = [_coefficient(k, of) for k, of in enumerate(self.area_function)]
        return table


def _coefficient(k: int, value: Quantity) -> float | str:
    """Coefficient k of an area function, in m^(2 − 1/2^(k−1)) unless it has a unit."""
    below = 2**k // 2
    unit = "dimensionless" if k == 0 else "m" if k == 1 else f"m^({2 * below - 1}/{below})"
    found = written(value, f"area_function[{k}]", unit)
    return found if isinstance(found, str) or k == 0 else f"{found!r} {unit}"
