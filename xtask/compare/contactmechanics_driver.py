"""ContactMechanics: its constrained conjugate gradients on its free (non-periodic) or periodic half-space.

Its tolerances are absolute, for a gap and a force on an element, and relative for a change of the total force. All
three are derived from one relative tolerance with the problem's length and peak pressure. The PyPI package is serial.
"""

from importlib.metadata import version

import ContactMechanics
import numpy as np
from SurfaceTopography import Topography

import driver
from problem import MODULUS, SIDE

LONGEST = 20000


def setup(problem, tolerance, threads):
    sides = (SIDE, SIDE)
    is_periodic = problem.is_periodic
    body = ContactMechanics.PeriodicFFTElasticHalfSpace if is_periodic else ContactMechanics.FreeFFTElasticHalfSpace
    half_space = body((problem.n, problem.n), MODULUS, sides)
    surface = Topography(-problem.gap, physical_sizes=sides, periodic=is_periodic)
    return problem, tolerance, ContactMechanics.make_system(substrate=half_space, surface=surface)


def solve(state):
    problem, tolerance, system = state
    return system.minimize_proxy(
        external_force=problem.force, maxiter=LONGEST, pentol=tolerance * problem.length,
        forcetol=tolerance * problem.peak_pressure * problem.element_side**2, thermotol=tolerance,
    )


def read(state, result):
    return {
        "pressure": np.asarray(result.jac) / state[0].element_side ** 2,
        "products": int(result.nfev),
        "converged": result.success,
        "own_error": float(result.maxcv["max_pen"] / state[0].length),
    }


driver.run(version("ContactMechanics"), setup, solve, read)
