"""The building blocks: compliance, influence coefficients, and the product of a body with a pressure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _pellicle, toml
from .errors import ArgumentError
from .height_map import checked

if TYPE_CHECKING:
    from .body import Foundation


def compliance(foundation: Foundation, wavenumber: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The compliance C(k) of a body at wavenumbers k (1/m), in m/Pa: displacement over pressure for a wave.

    The result has the shape of `wavenumber`. Displacements are positive into the body.
    """
    wavenumbers = np.array(wavenumber, dtype=np.float64)
    if not (np.isfinite(wavenumbers) & (wavenumbers > 0)).all():
        raise ArgumentError("wavenumber: found zero, a negative or a non-finite number, wanted positive finite numbers")
    found = _inner(foundation).compliance(np.ascontiguousarray(wavenumbers.ravel()))
    return found.reshape(wavenumbers.shape)


def influence_coefficients(foundation: Foundation, element_side: float, elements: int) -> npt.NDArray[np.float64]:
    """The displacement of one element under unit pressure on another, by their offset, in m/Pa.

    Coefficient `[m, n]` of the N × N array is for elements of side `element_side` (m), m apart along x and n along y.
    """
    return ElasticOperator(foundation, element_side, elements).coefficients


class ElasticOperator:
    """The product u = K p of a body with a pressure on N × N square elements of side `element_side` (m).

    `operator @ pressure` is the displacement (m, positive into the body) under an N × N pressure (Pa), or under its N²
    values row by row.
    """

    def __init__(self, foundation: Foundation, element_side: float, elements: int) -> None:
        if not (isinstance(elements, (int, np.integer)) and 1 <= elements <= 16384):
            raise ArgumentError(f"elements: found {elements}, wanted an integer from 1 to 16384")
        self.foundation = foundation
        self.element_side: float = float(element_side)
        self.elements: int = int(elements)
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
        given = np.asarray(pressure)
        if given.shape not in ((size, size), (size**2,)):
            raise ArgumentError(f"pressure: found shape {given.shape}, wanted {(size, size)} or {(size**2,)}")
        return self._operator.apply(checked(given.reshape(size, size), "pressure")).reshape(given.shape)

    def to_scipy(self) -> Any:
        """The matrix K as a `scipy.sparse.linalg.LinearOperator`; it is symmetric."""
        from scipy.sparse.linalg import LinearOperator

        def product(vector: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
            return self @ vector.reshape(-1)

        return LinearOperator(self.shape, matvec=product, rmatvec=product, dtype=np.float64)

    def __reduce__(self) -> tuple[type[ElasticOperator], tuple[Foundation, float, int]]:
        return ElasticOperator, (self.foundation, self.element_side, self.elements)

    def __repr__(self) -> str:
        return f"<ElasticOperator of {self.elements} × {self.elements} elements of side {self.element_side:g}>"


def _inner(foundation: Foundation) -> _pellicle.Foundation:
    return _pellicle.Foundation(toml.text({"foundation": foundation.as_table()}), "foundation")
