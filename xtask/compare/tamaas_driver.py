"""Tamaas: Polonsky-Keer with the pressure as unknown, on its non-periodic operator or, in a cell, its periodic one; its
saturated solver where a hardness limits the pressure.

The operator must be registered and also set: with only the first call it solves the periodic problem. Its tolerance
bounds its own relative complementarity error; missing it raises no error. It does not count products: two per iteration
and two before the first are assumed, with the iterations read from its log. The PyPI package is serial.
"""

import contextlib
import os
import re
import sys
import tempfile
from importlib.metadata import version

import numpy as np
import tamaas

import driver
from problem import MODULUS, SIDE

LONGEST = 20000
OPERATOR = "dcfft"


@contextlib.contextmanager
def everything_printed():
    """Provides a file that receives the output of this process, from Python or from a library."""
    with tempfile.TemporaryFile() as file:
        sys.stdout.flush()
        kept = [(stream, os.dup(stream)) for stream in (1, 2)]
        for stream, _ in kept:
            os.dup2(file.fileno(), stream)
        try:
            yield file
        finally:
            for stream, copy in kept:
                os.dup2(copy, stream)
                os.close(copy)


def setup(problem, tolerance, threads):
    tamaas.initialize(threads)
    tamaas.set_log_level(tamaas.LogLevel.warning)
    model = tamaas.Model(tamaas.model_type.basic_2d, [SIDE, SIDE], [problem.n, problem.n])
    model.E, model.nu = MODULUS, 0.0
    if np.isfinite(problem.hardness):
        solver = tamaas.KatoSaturated(model, -problem.gap, tolerance, problem.hardness)
    else:
        solver = tamaas.PolonskyKeerRey(model, -problem.gap, tolerance)
    if not problem.is_periodic:
        tamaas.ModelFactory.registerNonPeriodic(model, OPERATOR)
        solver.setIntegralOperator(OPERATOR)
    solver.max_iter, solver.dump_freq = LONGEST, 1
    return problem, tolerance, model, solver


def solve(state):
    problem, _, _, solver = state
    tamaas.set_log_level(tamaas.LogLevel.info)
    with everything_printed() as file:
        error = solver.solve(problem.mean_pressure)
        file.seek(0)
        log = file.read().decode(errors="replace")
    return error, log


def iterations(log):
    """The last iteration in the log, whose lines have three numbers: iteration, cost, error."""
    lines = re.findall(r"^\s*(\d+)\s+[-+0-9.e]+\s+[-+0-9.e]+\s*$", log, re.MULTILINE)
    return max(map(int, lines), default=None)


def read(state, result):
    _, tolerance, model, _ = state
    error, log = result
    last = iterations(log)
    return {
        "pressure": np.array(model.traction),
        "products": None if last is None else 2 * (last + 1),
        "converged": error <= tolerance,
        "own_error": float(error),
    }


driver.run(version("tamaas"), setup, solve, read)
