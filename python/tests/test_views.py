"""Results in the forms of other packages."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import pellicle as pl


def test_the_fields_are_a_data_set(case: pl.Case) -> None:
    pytest.importorskip("xarray")
    step = case.solve()[-1]
    fields = step.to_xarray()
    assert fields.pressure.dims == ("x", "y") and fields.pressure.units == "Pa"
    assert np.array_equal(fields.gap.values, step.gap)
    assert fields.attrs["force"] == 0.05
    # The largest pressure under a ball is on the axis, between two elements.
    assert abs(float(fields.pressure.idxmax("x").max())) <= step.x[1] - step.x[0]


def test_the_pressure_is_drawn(case: pl.Case) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    step = case.solve()[-1]
    ax = step.plot()
    image = ax.images[0]
    assert np.array_equal(image.get_array(), step.pressure.T)
    assert image.get_extent()[1] == pytest.approx(case.solve().summary["grid"]["side"] / 2)
    assert step.plot(ax) is ax
    assert ax.get_title() == f"Q = 50.000 mN, D = {step.penetration * 1e9:.2f} nm"
    assert ax.xaxis.get_major_formatter()(1e-6) == "1 µm"


def test_a_case_in_its_own_units_is_not_labelled_si() -> None:
    pytest.importorskip("matplotlib").use("agg")
    pytest.importorskip("xarray")
    step = pl.Case(pl.Foundation(pl.Material(1.0, 0.3)), pl.Paraboloid(1.0), force=0.01, elements=32).solve()[0]
    assert step.to_xarray().pressure.units == "case units" and not step.is_si
    assert step.plot().get_title().startswith("Q = 0.010000, D = 0.03")
    assert not pickle.loads(pickle.dumps(step)).is_si


def test_derivatives_are_available_if_requested(case: pl.Case) -> None:
    with pytest.raises(pl.ArgumentError, match="sensitivities=True"):
        case.solve()[0].sensitivities()
    case = case.replaced({"grid.side": "40 um", "solver.tolerance": 1e-10})
    step = case.replaced({"load.sensitivities": True}).solve()[1]
    found = step.sensitivities()["foundation.layer[0].thickness"]
    assert found.value == 2e-6 and found.penetration is not None
    # A difference so small that no element enters the contact: D is accurate to 1e-10 of 0.6 µm, its change is 1e-11 m.
    more, less = (case.replaced({"foundation.layer[0].thickness": t}).solve()[1] for t in (2.0002e-6, 1.9998e-6))
    assert found.penetration == pytest.approx((more.penetration - less.penetration) / 0.0004e-6, rel=1e-4)
