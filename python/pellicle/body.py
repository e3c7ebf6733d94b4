"""The elastic body: materials, layers and their support."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

from . import toml
from .given import part, parts
from .quantity import Quantity
from .table import Table


@dataclass(frozen=True)
class Grading(Table):
    """A Young's modulus that changes with depth, from the top of a layer to its bottom.

    Moduli are in Pa. A `"linear"` profile changes by equal amounts over equal depths, an `"exponential"` one by equal
    factors.
    """

    _names: ClassVar[Mapping[str, str]] = {"top": "from", "bottom": "to"}
    _part: ClassVar[str] = "grading"

    top: Quantity
    bottom: Quantity
    profile: Literal["linear", "exponential"] = "linear"


@dataclass(frozen=True)
class Material(Table):
    """An isotropic elastic material: Young's modulus in Pa, Poisson's ratio in [0, 0.5], and strengths.

    `yield_strength` is the von Mises stress and `tensile_strength` the largest principal stress that it bears, both in
    Pa; critical loads are found for the strengths given, and no stress is changed. The `hardness` of the topmost body,
    in Pa, limits the contact pressure.
    """

    young_modulus: Quantity | Grading
    poisson_ratio: float
    yield_strength: Quantity | None = None
    tensile_strength: Quantity | None = None
    hardness: Quantity | None = None

    def __post_init__(self) -> None:
        self._take()
        is_graded = isinstance(self.young_modulus, Grading)
        table = self.as_table() | ({"thickness": 1} if is_graded else {})
        self._check("layer" if is_graded else "material", table)


@dataclass(frozen=True)
class Spring(Table):
    """An imperfect bond: the bodies separate and slide in proportion to the traction, with these compliances in
    m/Pa."""

    _part: ClassVar[str] = "spring"
    normal_compliance: Quantity
    shear_compliance: Quantity


@dataclass(frozen=True)
class Layer(Table):
    """A layer: its thickness in m, its material, and its interface with the body below.

    Only the material of a layer may have a `Grading` as its Young's modulus. Interface strengths are in Pa,
    as is the residual stress, the same along x and y and positive in tension, which adds to the stresses inside.
    """

    _part: ClassVar[str] = "layer"
    thickness: Quantity
    material: Material
    interface: Literal["bonded", "frictionless"] | Spring | None = None
    residual_stress: Quantity | None = None
    interface_shear_strength: Quantity | None = None
    interface_tensile_strength: Quantity | None = None

    def as_table(self) -> dict[str, toml.Value]:
        """The keys of the layer and those of its material, side by side."""
        table = super().as_table()
        part("material", self.material, Material)
        material: dict[str, toml.Value] = table.pop("material")
        thickness = {"thickness": table.pop("thickness")}
        return thickness | material | table


@dataclass(frozen=True)
class Foundation(Table):
    """The elastic body: a substrate and the layers on it, from the surface down.

    The substrate is a material or `"rigid"`, a base that does not deform. The layers are a list, or anything else that
    gives them in order, or a single one.
    """

    _part: ClassVar[str] = "foundation"
    substrate: Material | Literal["rigid"]
    layers: Sequence[Layer] = ()

    def _take(self) -> None:
        if not isinstance(self.substrate, str):
            part("substrate", self.substrate, Material)
        object.__setattr__(self, "layers", parts("layers", self.layers, Layer))

    def as_table(self) -> dict[str, toml.Value]:
        """The keys `substrate` and `layer`."""
        substrate = self.substrate.as_table() if isinstance(self.substrate, Material) else self.substrate
        layers = [layer.as_table() for layer in self.layers]
        return {"substrate": substrate} | ({"layer": layers} if layers else {})
