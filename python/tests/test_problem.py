"""The discrete problem of a case, and the certificate of any pressure."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest

import pellicle as pl


@pytest.fixture
def pillars(body: pl.Foundation) -> pl.Case:
    """A ball on pillars, on a grid with a prescribed side."""
    relief = pl.Cylinders("2 um", "1 um", "6 um", young_modulus="3 GPa")
    return pl.Case(body, pl.Sphere("0.5 mm"), surface=relief, force="20 mN", side="60 um", elements=64)


def test_a_solution_is_certified_afresh(pillars: pl.Case) -> None:
    step, problem = pillars.solve()[0], pl.DiscreteProblem(pillars)
    judged = problem.judge(step.pressure, force=step.force)
    assert judged.certificate and judged.force == step.force
    # The program judges on a window of the grid, so sums and transforms round differently.
    assert judged.penetration == pytest.approx(step.penetration, rel=1e-13)
    assert judged.certificate.worst == pytest.approx(step.certificate.worst, abs=1e-12)
    assert pickle.loads(pickle.dumps(problem)).judge(step.pressure, force=step.force) == judged


def test_the_gap_is_the_sum_of_its_parts(pillars: pl.Case) -> None:
    step, problem = pillars.solve()[0], pl.DiscreteProblem(pillars)
    springs = problem.relief_compliance * step.pressure
    gap = problem @ step.pressure + springs + problem.initial_gap - step.penetration
    # Differences of numbers as large as the initial gap.
    np.testing.assert_allclose(gap, step.gap, atol=1e-14 * problem.initial_gap.max())
    assert problem.element_side == pytest.approx(60e-6 / 64, rel=1e-15)


def test_a_pressure_that_is_not_a_solution_is_not_certified(pillars: pl.Case) -> None:
    step, problem = pillars.solve()[0], pl.DiscreteProblem(pillars)
    # Twice the pressure carries twice the force.
    twice = problem.judge(2 * step.pressure, force=step.force).certificate
    assert not twice and twice.load == pytest.approx(1.0, rel=1e-6)
    pulling = step.pressure.copy()
    pulling[0, 0] = -1.0
    assert problem.judge(pulling, force=step.force).certificate.min_pressure == -1.0
    assert not problem.judge(np.zeros((64, 64)), force=step.force).certificate
    assert not problem.judge(step.pressure, penetration=2 * step.penetration).certificate


@pytest.mark.parametrize("load", [{}, {"force": 1.0, "penetration": 1.0}, {"force": 0.0}, {"penetration": math.nan}])
def test_an_invalid_load_is_refused(pillars: pl.Case, load: dict[str, Any]) -> None:
    with pytest.raises(pl.ArgumentError, match="found"):
        pl.DiscreteProblem(pillars).judge(np.zeros((64, 64)), **load)


def test_a_pressure_of_another_grid_is_refused_by_name(pillars: pl.Case) -> None:
    problem = pl.DiscreteProblem(pillars)
    for pressure in (np.zeros((32, 32)), np.zeros(64), np.full((64, 64), np.nan)):
        with pytest.raises(pl.ArgumentError, match="^pressure: found"):
            problem.judge(pressure, force=1.0)
