"""What callers may give: any sequence, arrays with units and masks, strings with units; and what is refused."""

from __future__ import annotations

import dataclasses
import tomllib
import warnings
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pellicle as pl

POLYMER = pl.Material("3 GPa", 0.35)
HARD = pl.Material("200 GPa", 0.25)
COATED = pl.Foundation(POLYMER, [pl.Layer("2 um", HARD), pl.Layer("1 um", POLYMER)])
LAYERS = COATED.layers
BASE = "foundation.substrate.young_modulus"

FORCES = np.linspace(1e-3, 2e-3, 5)
DEPTHS = 1e-9 * np.linspace(10.0, 16.0, 5)
HEIGHTS = 1e-9 * np.random.default_rng(1).normal(size=(8, 8))


def generator(items: Iterable[Any]) -> Iterator[Any]:
    yield from items


MADE: list[Callable[[Any], Any]] = [list, tuple, iter, generator, lambda items: map(lambda item: item, items)]


def case(**keys: Any) -> pl.Case:
    """A ball on a polymer, with few elements."""
    parts: dict[str, Any] = {"foundation": pl.Foundation(POLYMER), "indenter": pl.Sphere("1 mm"), "elements": 16}
    return pl.Case(**parts | keys)


def model() -> pl.Case:
    return case(indenter=pl.Paraboloid("10 um"), force="1 mN")


def fit(data: Any = (), **keys: Any) -> pl.Fit:
    return pl.Fit(model(), data, **{"unknown": {BASE: ("1 GPa", "10 GPa")}} | keys)


@pytest.mark.parametrize("made", MADE)
def test_layers_from_any_iterator_are_there(made: Callable[[Any], Any]) -> None:
    foundation = pl.Foundation(POLYMER, made(LAYERS))
    assert foundation == COATED and foundation.layers == LAYERS
    # A second use finds them again.
    for _ in range(2):
        assert len(case(foundation=foundation, force="1 mN").resolved["foundation"]["layer"]) == 2
    elastic = case(indenter=pl.Sphere("1 mm", body=pl.Foundation(POLYMER, made(LAYERS))), force="1 mN")
    assert len(elastic.resolved["indenter"]["body"]["layer"]) == 2
    assert (pl.compliance(foundation, 1e6) == pl.compliance(COATED, 1e6)).all()


def test_a_list_may_change_after_it_was_given() -> None:
    layers = [pl.Layer("2 um", HARD)]
    foundation = pl.Foundation(POLYMER, layers)
    layers.clear()
    assert len(foundation.layers) == 1
    assert pl.Foundation(POLYMER, LAYERS[0]) == pl.Foundation(POLYMER, LAYERS[:1])  # type: ignore[arg-type]


@pytest.mark.parametrize("made", [*MADE, np.array])
def test_sequences_are_read_once_wherever_one_is_taken(made: Callable[[Any], Any]) -> None:
    numbers = [1e-6, 2e-6]
    assert case(forces=made(numbers)) == case(forces=numbers)
    assert case(force=1e-3, boundary="periodic", sides=made(numbers)) == case(force=1e-3, boundary="periodic", sides=numbers)
    equal: list[Callable[[Any], Any]] = [
        lambda of: pl.Paraboloid(radii=of),
        lambda of: pl.Stress(depths=of),
        lambda of: pl.Wear(1e-15, distances=of),
        lambda of: pl.Cylinders(1e-7, 1e-8, 1e-6, offset=of),
        lambda of: pl.Rough(HEIGHTS, sides=of),
        lambda of: pl.Design(forces=of),
        lambda of: pl.OliverPharr(0.2, area_function=of),
        lambda of: pl.Data("a.csv", {"depth": 1}, omit={"a.csv": of}),
        lambda of: fit(unknown={BASE: of}),
    ]
    for make in equal:
        assert make(made(numbers)) == make(numbers)
    data = [pl.Data.of_arrays(force=FORCES, depth=DEPTHS), pl.Data.of_arrays(force=FORCES, depth=2 * DEPTHS)]
    if made is not np.array:
        assert fit(made(data)) == fit(data)
        assert pl.Stress(only=made(["max_shear"])) == pl.Stress(only=["max_shear"])
    assert pl.Data.of_arrays(force=made(FORCES), depth=made(DEPTHS)) == pl.Data.of_arrays(force=FORCES, depth=DEPTHS)
    assert (pl.compliance(COATED, made([1e5, 1e6])) == pl.compliance(COATED, [1e5, 1e6])).all()


def test_parts_with_arrays_are_compared_by_value() -> None:
    depths = np.array([1e-6, 2e-6])
    assert pl.Stress(depths) == pl.Stress([1e-6, 2e-6]) != pl.Stress(2 * depths)
    assert hash(pl.Stress(depths)) == hash(pl.Stress((1e-6, 2e-6)))
    assert dataclasses.replace(pl.Stress(depths), friction=0.1).depths == (1e-6, 2e-6)


@pytest.mark.parametrize("given", [{1e-3, 2e-3}, 1e-3, "1 mN", {"a": 1e-3}])
def test_what_has_no_order_or_no_items_is_no_sequence(given: Any) -> None:
    with pytest.raises(pl.Error, match="forces.*found"):
        case(forces=given)


@pytest.mark.parametrize("name", ["depth_zero", "shift", "force_zero", "drift"])
def test_off_switches_a_nuisance_off(name: str) -> None:
    off: list[Any] = ["off", False, np.False_]
    for value in off:
        nuisance = pl.Nuisances(**{name: value})
        assert nuisance.as_table() == {name: "off"}
    assert pl.Nuisances(**{name: True}).as_table() == {name: {"per": "curve"}}  # type: ignore[arg-type]
    others: list[Any] = ["on", "false", "", 0, 1, 1.0]
    for other in others:
        with pytest.raises(pl.ArgumentError, match=f"^{name}: found .*, wanted True or False, \"off\" or"):
            pl.Nuisances(**{name: other})


def test_a_zero_that_is_off_is_not_sought() -> None:
    rng = np.random.default_rng(1)
    force = np.geomspace(1e-5, 1e-3, 40)
    depth = (force * 0.75 / (3e9 / (1 - 0.35**2)) / np.sqrt(1e-5)) ** (2 / 3) + 0.2e-9 * rng.normal(size=40)
    data = pl.Data.of_arrays(force=force, depth=depth, noise=pl.Noise(depth="0.2 nm", correlation="none"))
    sought, off = (pl.identify(fit(data, nuisance=pl.Nuisances(depth_zero=zero)))[BASE] for zero in (True, "off"))
    # A zero that is known narrows the interval of the modulus.
    width = [np.diff(estimate.interval)[0] for estimate in (sought, off)]
    assert width[1] < 0.8 * width[0]


def test_switches_are_booleans() -> None:
    values: list[Any] = ["false", "off", 0, 1, None]
    for value in values:
        with pytest.raises(pl.ArgumentError, match="^sensitivities: found .*, wanted True or False"):
            case(force="1 mN", sensitivities=value)
    assert case(force="1 mN", sensitivities=np.True_).resolved["load"]["sensitivities"] is True
    with pytest.raises(pl.ArgumentError, match="^progress: found 'yes', wanted True or False or a function"):
        case(force="1 mN").solve(progress="yes")  # type: ignore[arg-type]


@pytest.mark.parametrize("direction", [90, -45.0, 6.3])
def test_a_bare_angle_beyond_a_full_turn_is_refused(direction: float) -> None:
    with pytest.raises(pl.CaseError, match=r"^Stress\(…\), key `direction`: found .*, wanted a unit, as in"):
        pl.Stress(friction=0.1, direction=direction)
    with pytest.raises(pl.CaseError, match="key `rotation`"):
        pl.Grooves(2e-6, 1e-8, period=8e-6, rotation=direction)
    assert pl.Stress(direction="90 deg") != pl.Stress(direction=np.pi / 2)


def test_numbers_among_strings_raise_no_warning() -> None:
    mixed = pl.Case(pl.Foundation(POLYMER), pl.Sphere(1e-3), force=1e-3, elements=16)
    for of in (mixed, mixed.replaced({"load.force": 2e-3})):
        assert [warning.code for warning in of.solve().warnings if warning.code == "bare-number"] == []
    # The file that it writes has their units.
    written = tomllib.loads(mixed.to_toml())
    assert written["indenter"]["radius"] == "0.001 m" and written["load"]["force"] == "0.001 N"
    file = pl.Case.from_string(mixed.to_toml())
    assert file == mixed and file.solve().warnings == mixed.solve().warnings
    bare = pl.Case.from_string(mixed.to_toml().replace('"0.001 m"', "0.001"))
    assert [warning.code for warning in bare.solve().warnings if warning.code == "bare-number"]
    ranges = case(forces=pl.Range(1e-3, "2 mN", 3), stress=pl.Stress(depths=[1e-6], friction=0.1, direction=1))
    table = tomllib.loads(ranges.to_toml())
    assert table["load"]["forces"] == {"from": "0.001 N", "to": "2 mN", "count": 3, "spacing": "linear"}
    assert table["stress"] == {"depths": ["1e-06 m"], "friction": 0.1, "direction": "1 rad"}
    assert pl.Case.from_string(ranges.to_toml()) == ranges


def test_numbers_alone_stay_numbers_in_any_system_of_units() -> None:
    bare = pl.Case(pl.Foundation(pl.Material(1, 0.3)), pl.Sphere(2.0), force=1e-6, elements=16)
    assert tomllib.loads(bare.to_toml())["indenter"]["radius"] == 2.0


def test_a_replaced_shape_brings_its_array_and_its_function() -> None:
    keys: dict[str, Any] = {"indenter": pl.Flat(), "pressure": "1 MPa", "boundary": "periodic", "side": "1 um"}
    first, second = (pl.Rough(times * HEIGHTS, side="1 um") for times in (1, 2))
    assert case(surface=first, **keys).replaced({"surface": second}) == case(surface=second, **keys)
    ball_on = {**keys, "indenter": pl.Sphere("1 mm")}
    assert case(**ball_on).replaced({"surface": second}) == case(surface=second, **ball_on)
    back = case(surface=first, **ball_on).replaced({"surface": pl.Bare()})
    assert back == case(surface=pl.Bare(), **ball_on) and not back._state[4]

    def ball(x: Any, y: Any) -> Any:
        return (x**2 + y**2) / 2e-3

    assert case(force="1 mN").replaced({"indenter": ball}) == case(indenter=ball, force="1 mN")
    assert case(indenter=ball, force="1 mN").replaced({"indenter": pl.Sphere("1 mm")}) == case(force="1 mN")
    by_keys = case(indenter=ball, force="1 mN").replaced({"indenter": {"kind": "sphere", "radius": "1 mm"}})
    assert by_keys == case(force="1 mN")
    with pytest.raises(pl.ArgumentError, match="^surface: found float, wanted a pellicle.Surface"):
        case(**ball_on).replaced({"surface": 1.0})


def test_a_cases_error_tells_what_it_found_in_its_sentence() -> None:
    refused: list[Callable[[], Any]] = [
        lambda: pl.Material(1.0, 2),
        lambda: pl.Material(-1.0, 0.3),
        lambda: pl.Cylinders(1e-6, 1e-7, period=1e-6),
        lambda: pl.Grooves(2e-6, 1e-7, period=1e-6),
    ]
    for make in refused:
        with pytest.raises(pl.CaseError) as raised:
            make()
        error = raised.value
        assert error.found and f"found {error.found}" in str(error)
        assert error.wanted and f"wanted {error.wanted}" in str(error)


def test_wrong_types_are_told_of_by_the_package(tmp_path: Path) -> None:
    any_of: Any = object()
    solved = case(force="1 mN")
    nowhere = tmp_path / "none" / "x.toml"
    refused: list[tuple[str, Callable[[], Any]]] = [
        ("layers: found str", lambda: pl.Foundation(POLYMER, "x")),  # type: ignore[arg-type]
        (r"layers\[0\]: found Material", lambda: pl.Foundation(POLYMER, [POLYMER])),  # type: ignore[list-item]
        ("layers: found NoneType", lambda: pl.Foundation(POLYMER, None)),  # type: ignore[arg-type]
        ("substrate: found Layer", lambda: pl.Foundation(LAYERS[0])),  # type: ignore[arg-type]
        ("material: found str", lambda: pl.Layer("1 um", "x")),  # type: ignore[arg-type]
        ("threads: found '2'", lambda: solved.solve(threads="2")),  # type: ignore[arg-type]
        ("threads: found 1.5", lambda: solved.solve(threads=1.5)),  # type: ignore[arg-type]
        ("element_side: found object", lambda: pl.ElasticOperator(COATED, any_of, 4)),
        ("foundation: found str", lambda: pl.compliance("x", 1.0)),  # type: ignore[arg-type]
        ("case: found str", lambda: pl.DiscreteProblem("x")),  # type: ignore[arg-type]
        ("force: found object", lambda: pl.DiscreteProblem(solved).judge(np.zeros((16, 16)), force=any_of)),
        ("unknown: found list, wanted a dict", lambda: fit(unknown=[BASE])),
        ("parameters: found tuple, wanted a dict", lambda: pl.Nuisances(parameters=[BASE])),  # type: ignore[arg-type]
        ("data: found NoneType", lambda: fit(None)),
        (r"data\[0\]: found str", lambda: fit(["x"])),
        ("nuisance: found str", lambda: fit(nuisance="off")),
        ("values: found list, wanted a dict", lambda: solved.replaced(["x"])),  # type: ignore[arg-type]
        ("condition: found int", lambda: pl.find(solved, 3, by="load.force")),  # type: ignore[arg-type]
        ("within: found object", lambda: pl.find(solved, "max_pressure < 2 GPa", by="load.force", within=any_of)),
        ("sides: found 3, wanted two", lambda: pl.Rough.sampled(lambda x, y: x, 4, sides=3)),  # type: ignore[arg-type]
    ]
    for message, use in refused:
        with pytest.raises(pl.ArgumentError, match=f"^{message}"):
            use()
    for write in (solved.to_toml, fit().to_toml, solved.solve().report):
        with pytest.raises(pl.RunError, match="cannot be written: No such file") as raised:
            write(nowhere)
        assert raised.value.path == nowhere


@pytest.mark.parametrize(
    "make",
    [
        lambda: pl.Stress(friction=-0.1),
        lambda: pl.Stress(only=["vm"]),  # type: ignore[list-item]
        lambda: pl.Wear(1e-15),
        lambda: pl.Wear("1 m", distance=1.0),
        lambda: pl.Nuisances(parameters={BASE: 3}),  # type: ignore[dict-item]
    ],
)
def test_a_part_is_checked_as_it_is_made(make: Callable[[], Any]) -> None:
    with pytest.raises(pl.Error):
        make()
