"""Stresses in the body under a step."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

import pellicle as pl

GLASS = pl.Foundation(pl.Material("70 GPa", 0.22))


@pytest.fixture
def step() -> pl.Step:
    """Hertz: a paraboloid on glass."""
    return pl.Case(GLASS, pl.Paraboloid("10 mm"), force="10 N", elements=64).solve()[0]


def test_below_hertz_contact_the_stress_on_the_axis_is_the_closed_form(step: pl.Step) -> None:
    radius, peak = 100.648e-6, 471.335e6
    depths = np.array([0.5, 1.0, 2.0]) * radius
    found = step.stress(depths)
    assert found.body == ("substrate",) * 3 and np.allclose(found.depth, depths, rtol=1e-15)
    middle = np.abs(found.x).argmin()
    # σ_zz = −p0/(1 + z²/a²) on the axis; the nearest points lie half an element off the axis, and the grid error of the
    # pressure is about 0.1 %.
    wanted = -peak / (1 + (depths / radius) ** 2)
    np.testing.assert_allclose(found["szz"][:, middle, middle], wanted, rtol=0.01)


def test_an_interface_has_two_planes_with_one_traction(body: pl.Foundation) -> None:
    step = pl.Case(body, pl.Sphere("0.5 mm"), force="50 mN", elements=32).solve()[0]
    found = step.stress(["1 um", "2 um"], extent="20 um")
    assert found.body == ("layer[0]", "layer[0]", "substrate")
    assert np.abs(found.x).max() <= 10e-6
    above, below = found["szz"][1:]
    np.testing.assert_allclose(above, below, atol=1e-9 * np.abs(above).max())
    assert np.abs(found["sxx"][1] - found["sxx"][2]).max() > 0.1 * np.abs(above).max()


def test_the_shear_stress_below_a_sliding_contact_carries_the_friction(step: pl.Step) -> None:
    side = 2 * step.x[-1]
    still, sliding = (step.stress(["1 um"], extent=side, friction=friction)["sxz"] for friction in (0.0, 0.3))
    # Equilibrium: below the surface the shear carries the friction, except for a part of about depth over side that
    # leaves the domain.
    assert abs(still.sum()) < 1e-9 * abs(sliding.sum())
    element = step.x[1] - step.x[0]
    assert abs(sliding.sum()) * element**2 == pytest.approx(0.3 * step.force, rel=0.02)


def test_invalid_depths_are_refused_with_their_key(step: pl.Step) -> None:
    with pytest.raises(pl.CaseError, match="depths"):
        step.stress([-1.0])
    with pytest.raises(pl.CaseError, match="extent"):
        step.stress(extent="1 m")


def test_stresses_under_a_step_from_a_pickle_have_the_same_bits(body: pl.Foundation) -> None:
    elastic = pl.Sphere("0.5 mm", young_modulus="600 GPa", poisson_ratio=0.22)
    path = pl.Case(body, elastic, forces=["5 mN", "50 mN"], elements=32).solve()
    requests: list[dict[str, Any]] = [{}, {"depths": ["1 um", "2 um"], "friction": 0.3, "direction": "30 deg"}]
    for kept in (pickle.loads(pickle.dumps(path)), pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(path))))):
        for step, again in zip(path, kept, strict=True):
            for keys in requests:
                found, wanted = again.stress(**keys), step.stress(**keys)
                assert found.body == wanted.body and np.array_equal(found.depth, wanted.depth)
                assert all(np.array_equal(found[name], wanted[name]) for name in wanted)
    step = pickle.loads(pickle.dumps(path[1]))
    assert np.array_equal(step.stress()["szz"], path[1].stress()["szz"])
    with pytest.raises(pl.CaseError, match="depths"):
        step.stress([-1.0])


def test_stresses_are_a_data_set(step: pl.Step) -> None:
    found = step.stress(["10 um", "20 um"])
    pytest.importorskip("xarray")
    fields = found.to_xarray()
    assert fields.von_mises.dims == ("plane", "x", "y") and fields.von_mises.units == "Pa"
    assert list(found) == list(fields.data_vars)
