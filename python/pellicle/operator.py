"""The building blocks: compliance, influence coefficients, and the product of a body with a pressure."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _pellicle, toml
from .body import Foundation
from .errors import ArgumentError
from .given import array, integer, part
from .height_map import checked
from .quantity import Quantity, number


def compliance(foundation: Foundation, wavenumber: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The compliance C(k) of a body at wavenumbers k (1/m), in m/Pa: displacement over pressure for a wave.

    The result has the shape of `wavenumber`, which may have a unit of its own. Displacements are positive into the
    body.
    """
    wavenumbers = array("wavenumber", wavenumber, "1/m")
    if not (np.isfinite(wavenumbers) & (wavenumbers > 0)).all():
        raise ArgumentError("wavenumber: found zero, a negative or a non-finite number, wanted positive finite numbers")
    found = _inner(foundation).compliance(np.ascontiguousarray(wavenumbers.ravel()))
    return found.reshape(wavenumbers.shape)


def influence_coefficients(foundation: Foundation, element_side: Quantity, elements: int) -> npt.NDArray[np.float64]:
    """The displacement of one element under unit pressure on another, by their offset, in m/Pa.

    Coefficient `[m, n]` of the N × N array is for elements of side `element_side` (m), m apart along x and n along y.
    """
    return ElasticOperator(foundation, element_side, elements).coefficients


class ElasticOperator:
    """The product u = K p of a body with a pressure on N × N square elements of side `element_side` (m).

    `operator @ pressure` is the displacement (m, positive into the body) under an N × N pressure (Pa), or under its N²
    values row by row.
    """

    def __init__(self, foundation: Foundation, element_side: Quantity, elements: int) -> None:
        self.foundation = foundation
        self.element_side: float = number("element_side", element_side, "m")
        """Side of an element, m."""
        self.elements: int = integer("elements", elements, 1, 16384)
        """Elements per side, N."""
        self._operator = _pellicle.Operator(_inner(foundation), self.element_side, self.elements)

    @property
    def shape(self) -> tuple[int, int]:
        """The shape of the matrix K, N² × N²."""
        return self.elements**2, self.elements**2

    @property
    def coefficients(self) -> npt.NDArray[np.float64]:
        """The coefficients by offset, m/Pa; see `influence_coefficients`."""
        return self._operator.coefficients()

    def __matmul__(self, pressure: npt.ArrayLike) -> npt.NDArray[np.float64]:
        size = self.elements
        given = array("pressure", pressure, "Pa")
        if given.shape not in ((size, size), (size**2,)):
            raise ArgumentError(f"pressure: found shape {given.shape}, wanted {(size, size)} or {(size**2,)}")
        return self._operator.apply(checked("pressure", given.reshape(size, size), "Pa")).reshape(given.shape)

    def to_scipy(self) -> Any:
        """The matrix K as a `scipy.sparse.linalg.LinearOperator`; it is symmetric."""
        from scipy.sparse.linalg import LinearOperator

        def product(vector: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
            return self @ vector.reshape(-1)

        return LinearOperator(self.shape, matvec=product, rmatvec=product, dtype=np.float64)

    def __reduce__(self) -> tuple[type[ElasticOperator], tuple[Foundation, float, int]]:
        return ElasticOperator, (self.foundation, self.element_side, self.elements)

    def __repr__(self) -> str:
        return f"<ElasticOperator of {self.elements} × {self.elements} elements of side {self.element_side:g} m>"


def _inner(foundation: Foundation) -> _pellicle.Foundation:
    table = part("foundation", foundation, Foundation).as_table()
    return _pellicle.Foundation(toml.text({"foundation": table}), "Foundation(…)")
