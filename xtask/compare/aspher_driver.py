"""aspher, run in two ways, each the fastest for its accuracy.

By default: nested grids with the exact FFT operator, the full-grid preconditioner, and coarse grids solved to 1e-6.
With the option active-set: its H2 operator with active_set=True, which solves the finest grid only on the elements near
the coarse contact, with all else by default. In a periodic cell: nested grids with its periodic operator, which chooses
the full-grid preconditioner by default.

Its tolerance is relative to the range of the gap over the whole square: for the paraboloid, 11 times looser than one
relative to the Hertzian approach. It counts products on the finest grid. Its threads are OpenMP's.
"""

import sys
from importlib.metadata import version

import aspher

import driver
from problem import MODULUS, SIDE

COARSEST = 64
LONGEST = 20000
WAYS = {
    "fft": {"backend": "fft", "coarse_tol": 1e-6, "precond_engine": "fft"},
    "active-set": {"backend": "h2", "active_set": True},
}

PERIODIC = {"backend": "periodic", "coarse_tol": 1e-6}


def setup(problem, tolerance, threads):
    if problem.is_periodic:
        return problem, tolerance, PERIODIC
    return problem, tolerance, WAYS[sys.argv[6] if len(sys.argv) > 6 else "fft"]


def solve(state):
    problem, tolerance, way = state
    return aspher.solve_nested(
        grid_size=problem.n, domain_size=SIDE, E_star=MODULUS, gap=problem.gap.ravel(),
        p_nominal=problem.mean_pressure, tol=tolerance, max_iter=LONGEST, coarsest=min(COARSEST, problem.n // 2), **way,
    )


def read(state, result):
    return {
        "pressure": result.pressure,
        "products": int(result.matvec_count),
        "converged": str(result.status).endswith("converged"),
        "own_error": float(max(result.fw_error, result.penetration_error)),
    }


driver.run(version("aspher"), setup, solve, read)
