"""A model for nanite and PyJibe: a paraboloid on a layer bonded to a base, solved by Pellicle in place of a formula.

    from nanite import load_group
    from nanite.model import load_model_from_file

    load_model_from_file("nanite_layer.py", register=True)
    curve = load_group("cell.jpk-force")[0]
    curve.fit_model(model_key="pellicle_layer", params_initial=None)

In PyJibe: Edit, Preferences, Extensions, Add. The thickness of the layer and the base are parameters that a fit holds.
Needs pellicle, numpy, scipy and lmfit (of nanite).
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicSpline

import pellicle as pl

Array = npt.NDArray[np.float64]

POINTS = 16
"""Depths that are solved; the logarithm of the force between them is a cubic spline, right to 1e-4."""
RANGE = 200.0
"""The deepest over the shallowest of them; below, where no layer is felt or the force is small, F ~ δ^1.5."""


@lru_cache(maxsize=64)
def _solved(ratio: float, nu: float, base_nu: float, radius: float, deepest: float) -> CubicSpline:
    """ln F over ln δ for a layer of unit thickness and unit modulus on a base of modulus `ratio`."""
    body = pl.Foundation(pl.Material(ratio, base_nu), [pl.Layer(1.0, pl.Material(1.0, nu))])
    depths = np.geomspace(deepest / RANGE, deepest, POINTS)
    # Each on a grid of its own size.
    cases = (pl.Case(body, pl.Paraboloid(radius), penetration=float(depth), elements=64) for depth in depths)
    return CubicSpline(np.log(depths), [math.log(case.solve()[-1].force) for case in cases])


def layer(
    delta: Array,
    E: float,
    R: float,
    nu: float,
    h: float,
    E_base: float,
    nu_base: float,
    contact_point: float = 0,
    baseline: float = 0,
) -> Array:
    r"""A paraboloid on a layer that is bonded to a base.

    Without approximation for the thickness: the linear elastic contact of a rigid, frictionless paraboloid with a layer
    on a half-space is solved numerically, with a certificate.

    Parameters
    ----------
    delta: 1d ndarray
        Indentation [m]
    E: float
        Young's modulus of the layer [Pa]
    R: float
        Tip radius [m]
    nu: float
        Poisson's ratio of the layer
    h: float
        Thickness of the layer [m]
    E_base: float
        Young's modulus of the base [Pa]
    nu_base: float
        Poisson's ratio of the base
    contact_point: float
        Indentation offset [m]
    baseline: float
        Force offset [N]

    Returns
    -------
    F: float
        Force [N]
    """
    depth = np.asarray(contact_point - delta, dtype=np.float64) / h
    force = np.full(depth.shape, float(baseline))
    touching = depth > 0
    if not touching.any():
        return force
    # Powers of 1.2, so that a fit that moves the contact point a little solves nothing anew.
    deepest = 1.2 ** math.ceil(math.log(depth.max(), 1.2))
    solved = _solved(E_base / E, nu, nu_base, R / h, deepest)
    shallowest = deepest / RANGE
    at = np.log(np.maximum(depth[touching], shallowest))
    below = np.minimum(depth[touching] / shallowest, 1.0) ** 1.5
    # Forces in units of E h².
    force[touching] += E * h**2 * np.exp(solved(at)) * below
    return force


def get_parameter_defaults() -> Any:
    """The parameters with their starts, in the order of their keys."""
    import lmfit

    params = lmfit.Parameters()
    params.add("E", value=3e3, min=1e-3)
    params.add("R", value=10e-6, min=0, vary=False)
    params.add("nu", value=0.5, min=0, max=0.5, vary=False)
    params.add("h", value=5e-6, min=0, vary=False)
    params.add("E_base", value=70e9, min=0, vary=False)
    params.add("nu_base", value=0.22, min=0, max=0.5, vary=False)
    params.add("contact_point", value=0)
    params.add("baseline", value=0)
    return params


model_doc = layer.__doc__
model_func = layer
model_key = "pellicle_layer"
model_name = "parabolic indenter on a layer (Pellicle)"
parameter_keys = ["E", "R", "nu", "h", "E_base", "nu_base", "contact_point", "baseline"]
parameter_names = [
    "Young's Modulus",
    "Tip Radius",
    "Poisson's Ratio",
    "Layer Thickness",
    "Young's Modulus of the Base",
    "Poisson's Ratio of the Base",
    "Contact Point",
    "Force Baseline",
]
parameter_units = ["Pa", "m", "", "m", "Pa", "", "m", "N"]
valid_axes_x = ["tip position"]
valid_axes_y = ["force"]
