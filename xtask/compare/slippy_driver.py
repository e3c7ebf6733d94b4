"""slippy: its Polonsky-Keer solver on its own planned non-circular convolution, called directly.

Its tolerance bounds the relative change of the pressure in one step. Products are counted by wrapping its operator. Its
threads are FFTW's; the rest is serial. Planning the transforms is part of the setup.
"""

from importlib.metadata import version

import numpy as np
import slippy
import slippy.core as core

import driver
from problem import MODULUS

LONGEST = 20000


class Counted:
    """An operator that counts its calls."""

    def __init__(self, operator):
        self.operator, self.calls = operator, 0

    def __call__(self, loads):
        self.calls += 1
        return self.operator(loads)


def setup(problem, tolerance, threads):
    slippy.CORES = threads
    n, spacing = problem.n, (problem.element_side, problem.element_side)
    # E* = 2 G / (1 - v), so that G = E*/2 at v = 0
    influence = core.elastic_influence_matrix_spatial("zz", (2 * n, 2 * n), spacing, shear_mod=MODULUS / 2.0, v=0.0)
    operator = core.plan_convolve(np.zeros((n, n)), influence, None, circular=False, fft_im=False)
    return problem, tolerance, spacing, Counted(operator)


def solve(state):
    problem, tolerance, spacing, operator = state
    return core.polonsky_and_keer(
        operator, np.ones_like(problem.gap), problem.gap, problem.force, spacing, eps_0=tolerance, max_it=LONGEST
    )


def read(state, result):
    failed, pressure, _ = result
    return {"pressure": pressure, "products": state[3].calls, "converged": not failed, "own_error": None}


driver.run(version("slippy"), setup, solve, read)
