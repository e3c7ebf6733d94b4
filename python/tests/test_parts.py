"""The building blocks: compliance, coefficients, operator."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest

import pellicle as pl

GLASS = pl.Foundation(pl.Material("70 GPa", 0.22))
COATED = pl.Foundation(pl.Material("3 GPa", 0.35), [pl.Layer("2 um", pl.Material("200 GPa", 0.25))])


def test_the_compliance_of_a_half_space_is_the_closed_form() -> None:
    k = np.array([[1e3, 1e6], [2e6, 1e9]])
    # C = 2 (1 − ν²)/(E k), to a few roundings.
    np.testing.assert_allclose(pl.compliance(GLASS, k), 2 * (1 - 0.22**2) / (70e9 * k), rtol=1e-14)
    assert pl.compliance(GLASS, 1e6).shape == ()


@pytest.mark.parametrize("wavenumber", [0.0, -1.0, math.nan, [1.0, math.inf]])
def test_an_invalid_wavenumber_is_refused(wavenumber: float) -> None:
    with pytest.raises(pl.ArgumentError, match="wavenumber: found"):
        pl.compliance(GLASS, wavenumber)


def test_coefficients_of_a_half_space_are_those_of_love() -> None:
    side = 1e-6
    coefficients = pl.influence_coefficients(GLASS, side, 16)
    # Love 1929: under its own unit pressure, the centre of a square sinks by 4 ln(1 + √2) (1 − ν²) L/(π E).
    own = 4 * math.asinh(1) * (1 - 0.22**2) * side / (math.pi * 70e9)
    assert coefficients[0, 0] == pytest.approx(own, rel=1e-14)
    assert np.array_equal(coefficients, coefficients.T)


def test_the_operator_is_the_matrix_of_the_coefficients() -> None:
    size = 8
    operator = pl.ElasticOperator(COATED, 1e-6, size)
    i, j = (index.ravel() for index in np.indices((size, size)))
    matrix = operator.coefficients[abs(i[:, None] - i), abs(j[:, None] - j)]
    pressure = np.random.default_rng(1).uniform(0, 1e9, (size, size))
    wanted = (matrix @ pressure.ravel()).reshape(size, size)
    # The rounding of transforms is relative to the largest displacement.
    np.testing.assert_allclose(operator @ pressure, wanted, atol=1e-13 * wanted.max())
    assert np.array_equal((operator @ pressure.ravel()).reshape(size, size), operator @ pressure)
    assert np.array_equal(operator @ np.asfortranarray(pressure), operator @ pressure)
    assert np.array_equal(pickle.loads(pickle.dumps(operator)) @ pressure, operator @ pressure)


def test_the_operator_gives_the_displacement_of_a_solution() -> None:
    case = pl.Case(COATED, pl.Sphere("0.5 mm"), force="50 mN", elements=32)
    path = case.solve()
    operator = pl.ElasticOperator(COATED, path.summary["grid"]["element_side"], 32)
    displacement = operator @ path[0].pressure
    np.testing.assert_allclose(displacement, path[0].displacement, atol=1e-13 * displacement.max())


def test_scipy_solves_with_the_operator() -> None:
    linalg = pytest.importorskip("scipy.sparse.linalg")
    operator = pl.ElasticOperator(GLASS, 1e-6 / 16, 16)
    sunk = np.full(256, 1e-9)
    pressure, failed = linalg.cg(operator.to_scipy(), sunk, rtol=1e-10)
    assert failed == 0
    stiffness = pressure.sum() * (1e-6 / 16) ** 2 / (70e9 / (1 - 0.22**2) * 1e-6 * 1e-9)
    # 1.152 for a square punch; 16 elements per side give about 2 % less.
    assert 1.11 < stiffness < 1.152


@pytest.mark.parametrize("pressure", [np.zeros((4, 5)), np.zeros(16 + 1), [[math.nan] * 4] * 4, [["a"] * 4] * 4])
def test_a_pressure_of_wrong_shape_is_refused_by_name(pressure: Any) -> None:
    with pytest.raises(pl.ArgumentError, match="pressure: found"):
        pl.ElasticOperator(GLASS, 1e-6, 4) @ pressure


def test_an_invalid_grid_is_refused() -> None:
    refused: list[Any] = [0, -1, 2.5, 10**6]
    for elements in refused:
        with pytest.raises(pl.ArgumentError, match="elements: found"):
            pl.ElasticOperator(GLASS, 1e-6, elements)
    with pytest.raises(pl.InfluenceError) as error:
        pl.ElasticOperator(GLASS, -1e-6, 4)
    assert error.value.found == -1e-6
