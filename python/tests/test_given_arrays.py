"""Arrays that callers give, with units and with masks; and quantities in the parts."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pellicle as pl

POLYMER = pl.Material("3 GPa", 0.35)
COATED = pl.Foundation(POLYMER, [pl.Layer("2 um", pl.Material("200 GPa", 0.25))])

FORCES = np.linspace(1e-3, 2e-3, 5)
DEPTHS = 1e-9 * np.linspace(10.0, 16.0, 5)
HEIGHTS = 1e-9 * np.random.default_rng(1).normal(size=(8, 8))


def case(**keys: Any) -> pl.Case:
    """A ball on a polymer, with few elements."""
    parts: dict[str, Any] = {"foundation": pl.Foundation(POLYMER), "indenter": pl.Sphere("1 mm"), "elements": 16}
    return pl.Case(**parts | keys)


def masked(array: npt.NDArray[np.float64], *at: Any) -> Any:
    """The array with these places masked; what is below the mask is far off."""
    copy, mask = array.copy(), np.zeros(array.shape, dtype=bool)
    for place in at:
        copy[place], mask[place] = 1e3, True
    return np.ma.MaskedArray(copy, mask)


def test_masked_heights_are_holes() -> None:
    given = masked(HEIGHTS, (1, 2), (5, 5))
    with pytest.raises(pl.ArgumentError, match=r"^heights: found 2 of 64 heights missing, the first at \[1, 2\], wanted"):
        pl.Rough(given, side="1 um")
    holes = HEIGHTS.copy()
    holes[1, 2] = holes[5, 5] = np.nan
    rough = pl.Rough(given, side="1 um", holes="interpolate")
    assert rough == pl.Rough(holes, side="1 um", holes="interpolate")
    filled = HEIGHTS.copy()
    for i, j in ((1, 2), (5, 5)):
        around = holes[i - 1 : i + 2, j - 1 : j + 2]
        filled[i, j] = around[np.isfinite(around)].mean()
    keys: dict[str, Any] = {"indenter": pl.Flat(), "pressure": "1 MPa", "boundary": "periodic", "side": "1 um"}
    by_hand = pl.DiscreteProblem(case(surface=pl.Rough(filled, side="1 um"), **keys)).initial_gap
    for holed in (rough, pl.Rough(holes, side="1 um", holes="interpolate")):
        found = pl.DiscreteProblem(case(surface=holed, **keys)).initial_gap
        # Means of neighbours are summed in another order.
        np.testing.assert_allclose(found, by_hand, rtol=0, atol=1e-14 * np.ptp(HEIGHTS))
    assert pl.Rough(masked(HEIGHTS), side="1 um") == pl.Rough(HEIGHTS, side="1 um")


def test_a_case_with_holes_is_written_and_read(tmp_path: Path) -> None:
    rough = pl.Rough(masked(HEIGHTS, (1, 2)), side="1 um", holes="interpolate")
    holed = case(indenter=pl.Flat(), surface=rough, pressure="1 MPa", boundary="periodic", side="1 um")
    holed.to_toml(tmp_path / "holed.toml")
    read = pl.Case.from_toml(tmp_path / "holed.toml")
    assert np.array_equal(pl.DiscreteProblem(read).initial_gap, pl.DiscreteProblem(holed).initial_gap)


@pytest.mark.parametrize(
    ("name", "use"),
    [
        ("forces", lambda of: case(forces=of(FORCES))),
        ("depths", lambda of: pl.Stress(depths=of(DEPTHS))),
        ("force", lambda of: pl.Data.of_arrays(force=of(FORCES), depth=DEPTHS)),
        ("wavenumber", lambda of: pl.compliance(COATED, of(1e15 * DEPTHS))),
        ("pressure", lambda of: pl.ElasticOperator(COATED, 1e-7, 8) @ of(HEIGHTS)),
        ("pressure", lambda of: pl.DiscreteProblem(case(force="1 mN")) @ of(np.zeros((16, 16)))),
    ],
)
def test_a_mask_where_there_are_no_holes_is_refused(name: str, use: Callable[[Any], Any]) -> None:
    def given(array: npt.NDArray[np.float64]) -> Any:
        return masked(array, 1, 3)

    with pytest.raises(pl.ArgumentError, match=rf"^{name}: found a masked array with \d+ of \d+ values masked, wanted"):
        use(given)
    use(masked)


def test_a_function_must_not_mask_its_values() -> None:
    def ball(x: Any, y: Any) -> Any:
        return np.ma.masked_where(x > 1e-6, (x**2 + y**2) / 2e-3)

    with pytest.raises(pl.ArgumentError, match="^indenter: found a masked array"):
        case(indenter=ball, force="1 mN").solve()


def test_arrays_of_a_units_library_are_converted(unit: Any) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        in_si = pl.Data.of_arrays(force=FORCES, depth=DEPTHS)
        # The same digits: a power of two times the unit.
        halves = np.array([0.5, 0.25])
        assert pl.Data.of_arrays(force=halves * unit.N, depth=halves * unit.m) == pl.Data.of_arrays(force=halves, depth=halves)
        given = pl.Data.of_arrays(force=FORCES * 1e3 * unit.mN, depth=[depth * 1e9 * unit.nm for depth in DEPTHS])
        numbers = [np.genfromtxt((of.rows_or_none() or "").splitlines()[1:], delimiter=",") for of in (given, in_si)]
        np.testing.assert_allclose(numbers[0], numbers[1], rtol=1e-15)
        assert pl.compliance(COATED, 1 / unit.um) == pl.compliance(COATED, 1e6)
        np.testing.assert_allclose(
            pl.compliance(COATED, np.array([1.0, 2.0]) / unit.um), pl.compliance(COATED, [1e6, 2e6]), rtol=1e-14
        )
        operator = pl.ElasticOperator(COATED, 100 * unit.nm, 8)
        np.testing.assert_allclose(operator @ (np.ones((8, 8)) * unit.MPa), operator @ np.full((8, 8), 1e6), rtol=1e-12)
        assert case(forces=np.array([1.0, 2.0]) * unit.mN) == case(forces=["0.001 N", "0.002 N"])
        assert pl.Stress(np.array([1.0, 2.0]) * unit.um).as_table()["depths"] == ["1e-06 m", "2e-06 m"]
        rough = pl.Rough(HEIGHTS / 1e-9 * unit.nm, side="1 um")
        np.testing.assert_allclose(rough.heights, HEIGHTS, rtol=1e-15)  # type: ignore[arg-type]
        ball = case(indenter=lambda x, y: ((x**2 + y**2) * 500 * 1e3) * unit.mm, force="1 mN").solve()[0]
        assert ball.penetration == pytest.approx(case(indenter=pl.Paraboloid("1 mm"), force="1 mN").solve()[0].penetration, rel=1e-3)


def test_the_dimension_of_an_array_is_checked(unit: Any) -> None:
    metres = FORCES * unit.m
    refused: list[tuple[str, Callable[[], Any]]] = [
        ("force: found values in meter, wanted a quantity in N", lambda: pl.Data.of_arrays(force=metres, depth=DEPTHS)),
        ("wavenumber: found values in meter, wanted a quantity in 1/m", lambda: pl.compliance(COATED, metres)),
        ("pressure: found values in meter", lambda: pl.ElasticOperator(COATED, 1e-7, 8) @ (HEIGHTS * unit.m)),
        ("heights: found values in newton", lambda: pl.Rough(HEIGHTS * unit.N, side="1 um")),
        (r"forces\[0\]: found 0.001 meter", lambda: case(forces=metres)),
        ("height_unit: found 'nm' beside", lambda: pl.Rough(HEIGHTS * unit.m, side="1 um", height_unit="nm")),
    ]
    for message, use in refused:
        with pytest.raises(pl.ArgumentError, match=f"^{message}"):
            use()


def test_strings_and_quantities_are_taken_by_the_parts(unit: Any) -> None:
    operator = pl.ElasticOperator(COATED, "100 nm", 4)
    assert operator.element_side == pytest.approx(1e-7, rel=1e-15)
    problem = pl.DiscreteProblem(case(force="1 mN"))
    pressure = case(force="1 mN").solve()[0].pressure
    judged = [problem.judge(pressure, force=force) for force in (1e-3, "0.001 N", 0.001 * unit.N)]
    assert judged[0] == judged[1] == judged[2]
    with pytest.raises(pl.ArgumentError, match=r"^element_side: found '1 mN' \(a force\), wanted a number, or a quantity in m"):
        pl.ElasticOperator(COATED, "1 mN", 4)


def test_a_wear_coefficient_has_its_own_unit(unit: Any) -> None:
    wear = pl.Wear(1e-6 * unit.mm**3 / (unit.N * unit.m), distance=1 * unit.m)
    assert case(force="1 mN", wear=wear).resolved["wear"]["coefficient"] == pytest.approx(1e-15, rel=1e-15)
    power = case(indenter=pl.PowerLaw(2, 1 * unit.mm), force="1 mN", wear=wear)
    assert power.resolved["indenter"]["coefficient"] == 1e-3
    of = power.replaced({"wear.coefficient": 2e-15 * unit.m**2 / unit.N, "indenter.coefficient": 2 * unit.mm})
    assert of.resolved["wear"]["coefficient"] == 2e-15 and of.resolved["indenter"]["coefficient"] == 2e-3


def test_coefficients_of_an_area_function_are_in_si_units(unit: Any) -> None:
    for given in ([24.5, 150e-9, 2e-14], [24.5, 150 * unit.nm, "2e-14 m^(3/2)"]):
        table = pl.OliverPharr(0.2, area_function=given).as_table()
        assert table["area_function"][0] == 24.5
        assert [float(text.split()[0]) for text in table["area_function"][1:]] == pytest.approx([150e-9, 2e-14])
        assert [text.split()[1] for text in table["area_function"][1:]] == ["m", "m^(3/2)"]


def test_a_map_of_a_function_takes_sides_with_units(unit: Any) -> None:
    def waves(x: Any, y: Any) -> Any:
        return 1e-9 * np.cos(1e6 * x + 0 * y)

    wanted = pl.Rough.sampled(waves, 8, sides=(1e-5, 2e-5))
    assert np.allclose(pl.Rough.sampled(waves, (8, 8), sides=("10 um", 20 * unit.um)).heights, wanted.heights, rtol=1e-12)  # type: ignore[arg-type]
    text = case(surface=wanted, force="1 mN").resolved
    assert text["surface"]["sides"] == [1e-5, 2e-5]
