"""Cases: built, read, written, compared, and refused where they are wrong."""

from __future__ import annotations

import copy
import dataclasses
import math
import pickle
import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

import pellicle as pl
from pellicle import toml
from pellicle.options import StressName
from pellicle.quantity import SI_UNITS


def test_a_case_written_to_a_file_is_read_back_equal(case: pl.Case) -> None:
    again = pl.Case.from_string(case.to_toml())
    assert again == case
    assert again.resolved == case.resolved


def test_omitted_arguments_have_the_defaults_of_the_case_file(body: pl.Foundation) -> None:
    resolved = pl.Case(body, pl.Berkovich(), force="1 mN").resolved
    assert resolved["grid"] == {"side": None, "elements": 256}
    assert resolved["indenter"]["tip_radius"] == 0.0
    assert resolved["foundation"]["layer"][0]["interface"] == "bonded"


EVERYTHING = pl.Case(
    pl.Foundation(
        pl.Material("7 GPa", 0.4, yield_strength="1 GPa", tensile_strength="2 GPa"),
        [
            pl.Layer(
                "10 nm",
                pl.Material(pl.Grading("70 GPa", "50 GPa", "exponential"), 0.3, yield_strength="3 GPa"),
                pl.Spring("0 m/Pa", "2 nm/GPa"),
                interface_shear_strength="0.4 GPa",
                interface_tensile_strength="0.3 GPa",
            ),
            pl.Layer("20 nm", pl.Material("30 GPa", 0.2, hardness="5 GPa"), "frictionless"),
        ],
    ),
    pl.Cone("70 deg", "400 nm", young_modulus="1141 GPa", poisson_ratio=0.07),
    surface=pl.Cylinders(
        "5 nm",
        "2 nm",
        "20 nm",
        lattice="hexagonal",
        offset=("1 nm", 0.0),
        young_modulus="1 GPa",
        law="logarithmic",
        rotation="15 deg",
        edge_radius="0.5 nm",
    ),
    forces=pl.Range("1 uN", "1 mN", 4, "log"),
    sensitivities=True,
    side="9 um",
    elements=64,
    tolerance=1e-6,
    method="gradient",
    stress=pl.Stress(
        depths=["5 nm", 0], extent="8 um", friction=0.3, direction="30 deg", only=get_args(StressName)
    ),
    output=pl.Output(fields="all", pictures="none", formats=["npz"], mean_pressure_over="2 nm"),
    title='a "quoted" title',
)


@pytest.mark.parametrize(
    ("make", "key"),
    [
        (lambda: pl.Material(-1, 0.3), "young_modulus"),
        (lambda: pl.Material("70 GPa", 0.6), "poisson_ratio"),
        (lambda: pl.Material(pl.Grading("7 GPa", "5 GPa"), -0.1), "poisson_ratio"),
        (lambda: pl.Grading("7 GPa", "5 nm"), "to"),
        (lambda: pl.Spring("-1 nm/GPa", 0), "normal_compliance"),
        (lambda: pl.Layer("0 nm", pl.Material(1, 0.3)), "thickness"),
        (lambda: pl.Sphere("0.5 N"), "radius"),
        (lambda: pl.Sphere(1.0, young_modulus=1.0), "poisson_ratio"),
        (lambda: pl.Cone("91 deg"), "half_angle"),
        (lambda: pl.PowerLaw(0.5, "1 um"), "exponent"),
        (lambda: pl.Film("1 nm", "hard"), "young_modulus"),
        (lambda: pl.Cylinders(2.0, 1.0, 3.0), "radius"),
        (lambda: pl.Cylinders(1.0, 1.0, 3.0, edge_radius=1.1), "edge_radius"),
        (lambda: pl.Dimples(1.0, 0.1, area_fraction=0.8), "area_fraction"),
        (lambda: pl.Grooves(2.0, 0.1, 1.9), "width"),
        (lambda: pl.Output(formats=["hdf5"]), "formats[0]"),  # type: ignore[list-item]
    ],
)
def test_a_part_is_refused_where_it_is_made(make: Callable[[], object], key: str) -> None:
    with pytest.raises(pl.CaseError) as refused:
        make()
    assert refused.value.key == key
    assert re.match(r"[A-Z][A-Za-z]+\(…\), key `", str(refused.value)), refused.value


def test_an_error_of_a_case_names_no_line_of_a_text_that_nobody_wrote() -> None:
    with pytest.raises(pl.CaseError, match=r"^Case\(…\), key `load.force`: found"):
        pl.Case(pl.Foundation(pl.Material(1, 0.3)), pl.Sphere(1), force="1 nm")


def test_every_key_can_be_written_and_read_back() -> None:
    resolved = EVERYTHING.resolved
    assert pl.Case.from_string(EVERYTHING.to_toml()) == EVERYTHING
    assert resolved["title"] == 'a "quoted" title'
    first, second = resolved["foundation"]["layer"]
    assert first["young_modulus"] == {"from": 70e9, "to": 50e9, "profile": "exponential"}
    assert first["interface"] == {"normal_compliance": 0.0, "shear_compliance": 2e-18}
    assert second["interface"] == "frictionless"
    assert resolved["surface"]["offset"] == [1e-9, 0.0]
    assert resolved["indenter"]["young_modulus"] == 1141e9
    # The factor of a degree is rounded once.
    assert math.isclose(resolved["indenter"]["half_angle"], math.radians(70.0), rel_tol=1e-15)
    assert resolved["load"] == {"forces": [1e-6, 1e-5, 1e-4, 1e-3], "sensitivities": True}
    assert resolved["stress"]["depths"] == [0.0, 5e-9]
    assert resolved["stress"]["only"] == list(get_args(StressName))
    files = {"fields": "all", "pictures": "none", "formats": ["npz"]}
    assert resolved["output"] == files | {"mean_pressure_over": 2e-9}


def test_an_indenter_may_have_layers_and_stresses_inside() -> None:
    steel, carbon = pl.Material("210 GPa", 0.3), pl.Layer("2 um", pl.Material("300 GPa", 0.2))
    coated = pl.Foundation(steel, [carbon])
    case = pl.Case(
        pl.Foundation("rigid"),
        pl.Paraboloid("3 mm", body=coated),
        force="1 N",
        elements=32,
        stress=pl.Stress(body="indenter"),
    )
    assert pl.Case.from_string(case.to_toml()) == case
    assert case.resolved["indenter"]["body"]["layer"][0]["thickness"] == 2e-6
    on_coated = pl.Case(coated, pl.Paraboloid("3 mm"), force="1 N", elements=32, stress=pl.Stress())
    inside, wanted = case.solve()[0], on_coated.solve()[0]
    assert inside.penetration == wanted.penetration
    names = [body["name"] for body in inside.summary["stress"]["bodies"]]
    assert names == ["indenter.layer[0]", "indenter.substrate"]
    with pytest.raises(pl.CaseError):
        pl.Case(coated, pl.Paraboloid("3 mm"), force="1 N", stress=pl.Stress(body="indenter"))


def test_a_contact_with_adhesion_pulls() -> None:
    body = pl.Foundation(pl.Material("2 MPa", 0.5))
    ball = pl.Paraboloid("10 um")
    case = pl.Case(body, ball, force="1 uN", elements=32, work_of_adhesion="50 mJ/m^2", adhesion="jkr")
    assert case.resolved["load"] == {"force": 1e-6, "work_of_adhesion": 0.05, "adhesion": "jkr"}
    path = case.solve()
    # -3/2 pi w R
    assert math.isclose(path.summary["pull_off"]["force"], -1.5 * math.pi * 0.05 * 1e-5, rel_tol=1e-10)
    assert path[0].force == pytest.approx(1e-6, rel=1e-9)


def test_a_hardness_limits_the_pressure() -> None:
    body = pl.Foundation(pl.Material(1.0, 0.3))
    case = pl.Case(body, pl.Paraboloid(1.0), force=1e-2, elements=32, hardness=0.1)
    assert pl.Case.from_string(case.to_toml()) == case and case.resolved["solver"]["hardness"] == 0.1
    step = case.solve()[0]
    assert step.certificate and step.certificate.over_limit == 0.0 and step.pressure.max() == 0.1
    assert 0.0 < step.fraction_at_limit < 1.0
    depth = step.plastic_depth
    assert depth.max() > 0.0 and np.array_equal(depth > 0.0, step.gap < -1e-8 * step.penetration)
    assert step.summary["plastic_depth"] == pytest.approx(depth.max(), rel=1e-9)


@pytest.mark.parametrize(
    "indenter",
    [
        pl.Paraboloid(1.0),
        pl.Sphere(1.0),
        pl.Cone(1.2),
        pl.PowerLaw(3.2, 1.0),
        pl.Berkovich(),
        pl.Vickers(0.1),
        pl.CubeCorner(0.1, 0.6),
        pl.FlatPunch(1.0),
        pl.IndenterMap([[0.0, 1.0], [1.0, 2.0]], side=10.0),
    ],
    ids=lambda indenter: type(indenter).__name__,
)
@pytest.mark.parametrize(
    "surface",
    [
        None,
        pl.Bare(),
        pl.Film(0.1, 1.0),
        pl.Cylinders(0.1, 0.1, 0.5),
        pl.Dimples(0.1, 0.02, area_fraction=0.2),
        pl.Grooves(0.1, 0.02, 0.5, "v", young_modulus=1.0),
        pl.Rough([[0.0, 0.1], [0.1, 0.0]], sides=(1.0, 1.0)),
        pl.ReliefMap([[0.0, 0.1], [0.1, 0.0]], side=1.0, compliance=0.1),
    ],
    ids=lambda surface: type(surface).__name__,
)
def test_every_indenter_can_be_combined_with_every_surface(indenter: pl.Indenter, surface: pl.Surface | None) -> None:
    body = pl.Foundation("rigid", [pl.Layer(1.0, pl.Material(1.0, 0.3))])
    case = pl.Case(body, indenter, surface=surface, penetrations=[0.1, 0.2])
    assert case.resolved["indenter"]["kind"] == type(indenter)._kind
    assert pickle.loads(pickle.dumps(case)) == case


LEAST = {
    "foundation": {"substrate": {"young_modulus": 1.0, "poisson_ratio": 0.3}, "layer": [{}]},
    "surface": {"kind": "bare"},
    "indenter": {"kind": "sphere", "radius": 1.0},
    "load": {"force": 1.0},
}


def keys_that_the_reader_knows(place: str, **values: Any) -> set[str]:
    """The keys that the program's reader lists when it finds an unknown one in this table."""
    document: dict[str, Any] = copy.deepcopy(LEAST)
    if place != "foundation.layer[0]":
        del document["foundation"]["layer"]
    table: Any = document
    for part in place.replace("[", ".").replace("]", "").split("."):
        table = table[int(part)] if isinstance(table, list) else table.setdefault(part, {})
    if values:
        table.clear()
    table |= values | {"no_such_key": 1}
    with pytest.raises(pl.CaseError) as error:
        pl.Case.from_string(toml.text(document))
    assert error.value.key == f"{place}.no_such_key"
    assert error.value.wanted is not None
    return set(error.value.wanted.removeprefix("one of ").split(", "))


def fields(*kinds: type[Any]) -> set[str]:
    return {field.name for kind in kinds for field in dataclasses.fields(kind)}


@pytest.mark.parametrize(
    ("place", "kind", "more", "less"),
    [
        ("foundation.substrate", pl.Material, set(), set()),
        ("surface", pl.Film, {"kind"}, set()),
        ("surface", pl.Cylinders, {"kind"}, set()),
        ("surface", pl.Dimples, {"kind"}, set()),
        ("surface", pl.Grooves, {"kind"}, set()),
        ("surface", pl.Rough, {"kind", "file"}, {"heights"}),
        ("surface", pl.ReliefMap, {"kind", "file"}, {"heights"}),
        ("indenter", pl.Paraboloid, {"kind"}, set()),
        ("indenter", pl.Sphere, {"kind"}, set()),
        ("indenter", pl.Cone, {"kind"}, set()),
        ("indenter", pl.PowerLaw, {"kind"}, set()),
        ("indenter", pl.Berkovich, {"kind"}, set()),
        ("indenter", pl.Vickers, {"kind"}, set()),
        ("indenter", pl.CubeCorner, {"kind"}, set()),
        ("indenter", pl.FlatPunch, {"kind"}, set()),
        ("indenter", pl.Flat, {"kind"}, set()),
        ("indenter", pl.IndenterMap, {"kind", "file"}, {"heights"}),
        ("stress", pl.Stress, set(), set()),
        ("wear", pl.Wear, set(), set()),
        ("output", pl.Output, set(), set()),
    ],
)
def test_no_table_of_the_case_file_has_keys_that_its_class_lacks(
    place: str, kind: type[Any], more: set[str], less: set[str]
) -> None:
    values = {} if not hasattr(kind, "_kind") or kind._kind is None else {"kind": kind._kind}
    known = keys_that_the_reader_knows(place, **values)
    assert (fields(kind) | more) - less == known
    of_maps = {"interpolation", "holes", "level", "edges", "origin"}
    words = {"lattice", "law", "profile", "fields", "pictures", "formats", "only", "body"}
    assert known - more - set(SI_UNITS) <= of_maps | words


def test_layers_loads_grid_and_solver_have_the_keys_of_the_case_file() -> None:
    layer = fields(pl.Layer, pl.Material) - {"material"}
    assert keys_that_the_reader_knows("foundation.layer[0]") == layer
    arguments = pl.Case.__init__.__annotations__.keys() - {"return"}
    of_tables = [keys_that_the_reader_knows(table) for table in ("load", "grid", "solver")]
    tables = {"foundation", "indenter", "surface", "stress", "wear", "output", "title"}
    assert arguments == set().union(tables, *of_tables)


def test_quantities_of_a_units_library_are_converted_and_their_dimension_is_checked(body: pl.Foundation) -> None:
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    of_pint = pl.Case(
        pl.Foundation(
            pl.Material(3 * unit.gigapascal, 0.35),
            [pl.Layer(2 * unit.micrometer, pl.Material(200 * unit.gigapascal, 0.25 * unit.dimensionless))],
        ),
        pl.Sphere(0.5 * unit.millimeter),
        force=5 * unit.millinewton,
    )
    assert of_pint == pl.Case(body, pl.Sphere("0.5 mm"), force="5 mN")
    with pytest.raises(pl.ArgumentError, match="radius: found 1 second, wanted a quantity in m"):
        pl.Case(body, pl.Sphere(1 * unit.second), force=1.0)


def test_numpy_numbers_are_accepted(body: pl.Foundation) -> None:
    forces = np.linspace(0.005, 0.05, 3)
    case = pl.Case(body, pl.Sphere(np.float64(5e-4)), forces=forces, elements=np.int64(64))  # type: ignore[arg-type]
    assert case.resolved["load"]["forces"] == forces.tolist()
    assert case.resolved["grid"]["elements"] == 64


def test_a_fault_is_reported_with_its_key(body: pl.Foundation) -> None:
    with pytest.raises(pl.CaseError) as error:
        pl.Case(body, pl.Sphere("5 mN"), force="1 N")
    assert error.value.key == "radius"
    assert error.value.found == '"5 mN" (a force)'
    assert "a positive length" in (error.value.wanted or "")
    with pytest.raises(pl.CaseError, match="wanted exactly one of force, forces, pressure, pressures"):
        pl.Case(body, pl.Sphere(1.0))
    with pytest.raises(pl.CaseError, match="found 0.6 for Poisson's ratio, wanted a number in"):
        pl.Material(1.0, 0.6)


@pytest.mark.parametrize("value", [None, object(), True, [1.0], math.nan, math.inf, "", "five nm"])
def test_a_value_that_is_not_a_quantity_is_refused(body: pl.Foundation, value: Any) -> None:
    with pytest.raises(pl.Error):
        pl.Case(body, pl.Sphere(value), force=1.0)


def test_a_value_that_cannot_be_written_to_a_case_file_is_refused(body: pl.Foundation) -> None:
    interface: Any = object()
    with pytest.raises(pl.ArgumentError, match="found object, wanted a"):
        pl.Layer(1.0, pl.Material(1.0, 0.3), interface)
    with pytest.raises(pl.ArgumentError, match="found object, wanted a"):
        pl.Material(1.0, interface)


@pytest.mark.parametrize("part", ["foundation", "indenter", "surface", "stress"])
def test_a_part_of_the_wrong_type_is_refused_by_name(body: pl.Foundation, part: str) -> None:
    parts: dict[str, Any] = {"foundation": body, "indenter": pl.Sphere(1.0), "force": 1.0}
    with pytest.raises(pl.ArgumentError, match=f"{part}: found int, wanted a pellicle."):
        pl.Case(**(parts | {part: 3}))


@pytest.mark.parametrize(
    "heights",
    [
        [1.0, 2.0],
        [[[1.0]]],
        [],
        [[]],
        [[1.0, math.nan]],
        [[1.0, math.inf]],
        [[1j, 2.0]],
        [["a", "b"]],
        [[True, False]],
    ],
)
def test_heights_that_are_not_a_map_are_refused_by_name(heights: Any) -> None:
    with pytest.raises(pl.ArgumentError, match="^heights: found"):
        pl.IndenterMap(heights, side=1.0)


def test_the_memory_order_of_an_array_does_not_matter(body: pl.Foundation) -> None:
    heights = np.arange(12.0).reshape(3, 4) ** 2 * 1e-9
    maps = [heights, np.asfortranarray(heights), heights[::-1][::-1], heights.astype(">f8")]
    cases = [pl.Case(body, pl.IndenterMap(map, side="1 um"), force="1 uN") for map in maps]
    assert all(case == cases[0] for case in cases)
    assert cases[0] != pl.Case(body, pl.IndenterMap(heights * 2, side="1 um"), force="1 uN")


def test_a_map_sampled_from_a_function_is_solved_like_its_shape(body: pl.Foundation) -> None:
    radius, load = 0.5e-3, {"force": "50 mN", "side": "40 um", "elements": 64}
    tip = pl.IndenterMap.sampled(lambda x, y: (x**2 + y**2) / (2 * radius), 101, sides=(50e-6, 50e-6))
    by_map = pl.Case(body, tip, **load).solve()[0]  # type: ignore[arg-type]
    by_name = pl.Case(body, pl.Paraboloid(radius), **load).solve()[0]  # type: ignore[arg-type]
    # Cubic interpolation is exact for a parabola, but heights are measured from the map's lowest sample: rounding.
    assert by_map.penetration == pytest.approx(by_name.penetration, rel=1e-7)
    for function in (lambda x, y: x[:2], lambda x, y: x * np.nan, lambda x, y: x > 0):
        with pytest.raises(pl.ArgumentError, match="^function: found"):
            pl.IndenterMap.sampled(function, 4, sides=(1.0, 1.0))


def test_a_map_copies_its_array() -> None:
    heights = np.zeros((2, 2))
    map = pl.IndenterMap(heights, side=1.0)
    heights[0, 0] = 7.0
    assert map == pl.IndenterMap(np.zeros((2, 2)), side=1.0)


def test_values_are_replaced_by_key(case: pl.Case) -> None:
    other = case.replaced({"foundation.layer[0].thickness": "1 um", "grid.elements": 64, "solver.tolerance": 1e-6})
    assert other.resolved["foundation"]["layer"][0]["thickness"] == 1e-6
    assert other.resolved["grid"]["elements"] == 64
    assert other.resolved["solver"]["tolerance"] == 1e-6
    assert case.resolved["grid"]["elements"] == 32
    for key in ("foundation.layer[1].thickness", "title.x", "foundation.layer.x"):
        with pytest.raises(pl.ArgumentError, match="values: found"):
            case.replaced({key: 1.0})


def test_a_case_file_is_read_from_its_path(case: pl.Case, tmp_path: Path) -> None:
    file = tmp_path / "two.toml"
    case.to_toml(file)
    assert pl.Case.from_toml(file) == case
    assert pl.Case.from_toml(str(file)).to_toml() == file.read_text()
    with pytest.raises(pl.RunError, match="cannot be read as a case file: No such file"):
        pl.Case.from_toml(tmp_path / "none.toml")


def test_the_title_of_a_file_without_one_is_its_name(tmp_path: Path) -> None:
    file = tmp_path / "glass.toml"
    file.write_text(pl.Case(pl.Foundation(pl.Material(1, 0.3)), pl.Sphere(1), force=1e-6).to_toml())
    assert pl.Case.from_toml(file).title == "glass"


def test_the_maps_of_a_case_are_found_from_any_folder(body: pl.Foundation, tmp_path: Path) -> None:
    here, there = tmp_path / "here", tmp_path / "there"
    here.mkdir()
    there.mkdir()
    heights = np.arange(12.0).reshape(3, 4) ** 2 * 1e-9
    case = pl.Case(body, pl.IndenterMap(heights, side="1 um"), surface=pl.Rough(heights, side="1 um"), force="1 uN")
    case.to_toml(here / "a.toml")
    assert sorted(file.name for file in here.iterdir()) == ["a-indenter.npy", "a-surface.npy", "a.toml"]
    read = pl.Case.from_toml(here / "a.toml")
    read.to_toml(there / "b.toml")
    again = pl.Case.from_toml(there / "b.toml")
    assert np.array_equal(np.load(tomllib.loads(again.to_toml())["indenter"]["file"]), heights)
    without_names = {"title", "surface", "indenter"}
    for other in (read, again):
        assert other.resolved["indenter"]["sides"] == case.resolved["indenter"]["sides"]
        assert {key: other.resolved[key] for key in other.resolved.keys() - without_names} == {
            key: case.resolved[key] for key in case.resolved.keys() - without_names
        }


def test_cases_are_compared_copied_and_pickled_by_value(case: pl.Case, body: pl.Foundation) -> None:
    assert case == pickle.loads(pickle.dumps(case)) == copy.deepcopy(case) == copy.copy(case)
    assert case != pl.Case(body, pl.Sphere("0.5 mm"), force="5 mN")
    assert case != "a case"
    with pytest.raises(TypeError, match="unhashable"):
        hash(case)


def test_a_case_has_readable_representations(case: pl.Case) -> None:
    assert repr(case) == "<Case 'two loads': sphere on 1 layer, 32 × 32 elements>"
    assert "<td>foundation.layer[0].thickness</td><td>2e-06</td>" in case._repr_html_()
