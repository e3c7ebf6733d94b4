"""The common part of all rivals' drivers: the command line, the clock, the peak memory, and the line of JSON.

    python aspher_driver.py CASE N THREADS TOLERANCE PRESSURE_FILE [OPTION]

The caller sets the environment's thread variables before the process starts. A rival consists of three functions:

    setup(problem, tolerance, threads)  -> state                everything that must be built before it can solve
    solve(state)                        -> result               from its own cold start
    read(state, result)                 -> dict                 pressure (n, n), products, converged, own_error

A small problem is solved first to load libraries, start threads and compile functions; then everything is built afresh
and timed once. The geometry (the array `problem.gap`) is given and not timed.
"""

import json
import resource
import sys
import time

import numpy as np

from problem import Problem

WARM_UP_ELEMENTS = 64


def run(version, setup, solve, read):
    """Solves the problem of the command line, writes its pressure and prints its measurement."""
    case, n, threads, tolerance, pressure_file = sys.argv[1:6]
    arguments = float(tolerance), int(threads)
    warm_up = setup(Problem("hertz", WARM_UP_ELEMENTS), *arguments)
    solve(warm_up)
    del warm_up
    problem = Problem(case, int(n))

    start, cpu = time.perf_counter(), time.process_time()
    state = setup(problem, *arguments)
    built = time.perf_counter()
    result = solve(state)
    solved, cpu = time.perf_counter(), time.process_time() - cpu
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    answer = read(state, result)
    np.save(pressure_file, np.asarray(answer["pressure"], dtype=float).reshape(problem.n, problem.n))
    sys.stdout.flush()
    print(json.dumps({
        "version": version,
        "setup_seconds": built - start,
        "solve_seconds": solved - built,
        "cpu_seconds": cpu,
        "products": answer["products"],
        "peak_bytes": peak * (1 if sys.platform == "darwin" else 1024),
        "converged": bool(answer["converged"]),
        "own_error": answer["own_error"],
    }))
