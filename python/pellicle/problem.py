"""The discrete problem of a case, for your own solvers, and the certificate of any pressure."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _pellicle
from .case import Case
from .errors import ArgumentError
from .given import part
from .height_map import checked
from .judgement import Certificate
from .quantity import Quantity, number


@dataclass(frozen=True, slots=True)
class Judgement:
    """The assessment of a pressure as a solution: its penetration (m), its force (N) and its certificate."""

    penetration: float
    force: float
    certificate: Certificate


class DiscreteProblem:
    """The problem of a case on its grid: find p ≥ 0 with g = K p + w* + g0 − D ≥ 0 and p g = 0.

    `problem @ p` is K p. Springs of compliance η shorten by w* = η p if their law is linear.
    """

    def __init__(self, case: Case) -> None:
        self.case: Case = part("case", case, Case)
        """The case as it was given."""
        self._problem = _pellicle.DiscreteProblem(case._case)

    @property
    def elements(self) -> int:
        """Elements per side, N."""
        return self._problem.elements

    @property
    def element_side(self) -> float:
        """Side of an element, m."""
        return self._problem.side / self._problem.elements

    @cached_property
    def initial_gap(self) -> npt.NDArray[np.float64]:
        """Initial gap g0 = f − f*, m: an N × N array, infinite where nothing can touch."""
        return self._problem.initial_gap()

    @cached_property
    def relief_compliance(self) -> npt.NDArray[np.float64]:
        """Compliance η of the relief at rest, m/Pa: an N × N array."""
        return self._problem.relief_compliance()

    def __matmul__(self, pressure: npt.ArrayLike) -> npt.NDArray[np.float64]:
        return self._problem.displacement(self._checked(pressure))

    def judge(
        self, pressure: npt.ArrayLike, *, force: Quantity | None = None, penetration: Quantity | None = None
    ) -> Judgement:
        """Assesses an N × N pressure (Pa) as a solution under a force (N), or at a penetration (m)."""
        if (force is None) == (penetration is None):
            raise ArgumentError("force: found both or neither of force and penetration, wanted one of them")
        load = None if force is None else number("force", force, "N")
        depth = 0.0 if penetration is None else number("penetration", penetration, "m")
        if load is not None and not 0.0 < load < math.inf:
            raise ArgumentError(f"force: found {force}, wanted a positive finite number")
        if not math.isfinite(depth):
            raise ArgumentError(f"penetration: found {penetration}, wanted a finite number")
        found, carried, lines = self._problem.judge(self._checked(pressure), load, depth)
        return Judgement(found, carried, Certificate(*lines))

    def _checked(self, pressure: Any) -> npt.NDArray[np.float64]:
        given, wanted = checked("pressure", pressure, "Pa"), (self.elements, self.elements)
        if given.shape != wanted:
            raise ArgumentError(f"pressure: found shape {given.shape}, wanted {wanted}")
        return given

    def __reduce__(self) -> tuple[type[DiscreteProblem], tuple[Case]]:
        return DiscreteProblem, (self.case,)

    def __repr__(self) -> str:
        return f"<DiscreteProblem of {self.case.title!r}: {self.elements} × {self.elements} elements>"
