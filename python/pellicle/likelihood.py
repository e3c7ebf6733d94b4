"""The likelihood of the data of a fit, for samplers."""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from . import _pellicle
from .case import checked_threads
from .errors import ArgumentError
from .fit import Fit
from .given import array
from .identification import fit_of
from .progress import FitProgress, reporting
from .waiting import finished


class Likelihood:
    """The likelihood of the data of a fit near its best fit, for samplers such as emcee.

    It is a function of values in SI units, the unknowns first, then the inexactly known numbers, as in `keys`. A call
    solves the curves of the fit and returns `ln (L/L_best)`, or -inf outside the bounds of the unknowns. The noise is
    that of the best fit; a size that the fit has estimated, and the shifts, drifts and frame compliance, are integrated
    out. Priors of the unknowns are not included. A copy in another process makes the fit again.
    """

    def __init__(self, fit: Fit | str | os.PathLike[str], *, threads: int | None = None) -> None:
        self.fit: Fit = fit_of(fit)
        """The fit as it was given."""
        run = self.fit.begun(is_measured=True).start_likelihood(checked_threads(threads))
        silent = reporting(False, self.fit, FitProgress)
        self._found: _pellicle.Likelihood = finished(run, lambda found: found, silent)

    @property
    def keys(self) -> list[str]:
        """Keys of the values."""
        return self._found.keys

    @property
    def best(self) -> npt.NDArray[np.float64]:
        """The values of the best fit."""
        return np.array(self._found.best, dtype=np.float64)

    def __call__(self, values: Sequence[float] | npt.NDArray[np.float64]) -> float:
        found = array("values", values, "dimensionless")
        if found.ndim != 1:
            raise ArgumentError(f"values: found an array of shape {found.shape}, wanted one axis")
        return self._found.logarithm(found.tolist())

    def __reduce__(self) -> tuple[type[Likelihood], tuple[Fit]]:
        return type(self), (self.fit,)

    def __repr__(self) -> str:
        return f"<Likelihood of {self.fit.title!r}: {len(self.keys)} values>"
