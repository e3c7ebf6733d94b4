"""Paths and steps: their numbers, arrays and columns, also after pickling."""

from __future__ import annotations

import copy
import gc
import pickle
import re
import weakref
from pathlib import Path

import numpy as np
import pytest

import pellicle as pl


@pytest.fixture
def path(case: pl.Case) -> pl.Path:
    return case.solve()


def test_pressures_add_up_to_the_force(path: pl.Path) -> None:
    for step in path:
        element = path.summary["grid"]["element_side"]
        # The line `load` of the certificate, and the rounding of a sum of a thousand numbers.
        assert abs(step.pressure.sum() * element**2 / step.force - 1) <= step.certificate.load + 1e-13


def test_fields_satisfy_the_contact_conditions(path: pl.Path) -> None:
    step = path[-1]
    assert step.certificate and step.status == "certified"
    assert (step.pressure >= 0).all()
    # The gap is recomputed from the pressure; the certificate bounds it relative to the penetration.
    rounding = 1e-14
    bound = 1.01 * step.certificate.gap_in_contact + rounding
    assert np.abs(step.gap[step.contact]).max() <= bound * step.penetration
    assert step.contact.sum() == step.contact_elements


def test_x_is_the_first_index(body: pl.Foundation) -> None:
    ellipsoid = np.fromfunction(lambda i, j: ((i - 10) ** 2 + 9 * (j - 10) ** 2) * 1e-9, (21, 21))
    case = pl.Case(body, pl.IndenterMap(ellipsoid, side="10 um"), force="3 mN", side="8 um", elements=32)
    i, j = np.nonzero(case.solve()[0].contact)
    assert np.ptp(i) > 1.5 * np.ptp(j)


def test_a_path_is_a_sequence_of_steps(path: pl.Path) -> None:
    assert len(path) == 2
    assert [step.index for step in path] == [0, 1]
    assert path[-1] == path[1] != path[0]
    assert path[::-1] == [path[1], path[0]]
    with pytest.raises(IndexError):
        path[2]


def test_the_pressure_is_a_view_of_the_solutions_memory(path: pl.Path) -> None:
    first, again = path[0].pressure, path[0].pressure
    assert first.ctypes.data == again.ctypes.data
    assert first.shape == (32, 32) and first.dtype == np.float64 and first.flags.c_contiguous
    with pytest.raises(ValueError, match="read-only"):
        first[0, 0] = 1.0


def test_a_pressure_outlives_its_path(case: pl.Case) -> None:
    path = case.solve()
    kept, wanted = path[0].pressure, path[0].pressure.copy()
    gone = weakref.ref(path)
    del path
    gc.collect()
    assert gone() is None
    assert np.array_equal(kept, wanted)


def test_the_curve_has_a_row_for_each_step(path: pl.Path) -> None:
    assert path.curve["force [N]"].tolist() == [0.005, 0.05]
    assert path.curve["force"] is path.curve["force [N]"]
    assert path.curve["penetration [m]"].tolist() == [step.penetration for step in path]
    assert path.curve["contact elements"].dtype == np.int64
    assert path.curve["certificate satisfied"].dtype == np.bool_
    with pytest.raises(KeyError):
        path.curve["contact"]


def test_the_curve_is_a_data_frame(path: pl.Path) -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(path.curve)
    assert frame.shape == (2, len(path.curve))


def test_an_empty_cell_of_a_curve_is_nan() -> None:
    curve = pl.Curve.of_csv("step,contact stiffness [N/m]\n0,\n1,2e0\n")
    assert np.isnan(curve["contact stiffness"][0]) and curve["contact stiffness"][1] == 2.0


def test_numbers_match_the_summary(path: pl.Path) -> None:
    step, summary = path[1], path.summary["steps"][1]
    names = [
        "force",
        "penetration",
        "max_pressure",
        "mean_pressure",
        "contact_area",
        "contact_area_on_relief",
        "contact_area_between",
        "contact_elements",
        "contact_radius",
        "contact_stiffness",
        "status",
    ]
    assert [getattr(step, name) for name in names] == [summary[name] for name in names]
    assert list(step.max_pressure_at) == summary["max_pressure_at"]
    assert step.certificate.worst == summary["certificate"]["worst"]
    assert step.grid_error.penetration is not None
    assert step.grid_error.penetration.estimate == summary["grid_error"]["penetration"]["estimate"]
    assert step.work.operator_applications == path.curve["operator applications"][1]


def test_paths_and_steps_survive_a_pickle(path: pl.Path) -> None:
    again = pickle.loads(pickle.dumps(path))
    assert again == path and again.summary == path.summary and again.is_whole
    for name in ("pressure", "displacement", "gap", "shortening", "profile", "mask"):
        assert np.array_equal(getattr(again[1], name), getattr(path[1], name)), name
    assert again.curve["force"].tolist() == path.curve["force"].tolist()
    assert pickle.loads(pickle.dumps(again)) == path
    step = pickle.loads(pickle.dumps(path[1]))
    assert step == path[1] and step.index == 1
    with pytest.raises(ValueError, match="read-only"):
        step.pressure[0, 0] = 1.0
    assert copy.deepcopy(path) is path


def test_an_uncertified_path_is_returned_with_a_warning(body: pl.Foundation) -> None:
    case = pl.Case(body, pl.Sphere("0.5 mm"), force="50 mN", side="10 um", elements=32)
    with pytest.warns(pl.NotCertifiedWarning, match="cut-off, do not use these numbers") as told:
        path = case.solve()
    assert [warning.message.code for warning in told] == ["cut-off"]  # type: ignore[union-attr]
    assert path.status == path[0].status == "cut-off"
    assert "cut-off" in [warning.code for warning in path[0].warnings]
    assert "cut-off" in [warning.code for warning in path.warnings]


def test_a_path_beyond_the_model_is_returned_with_the_impossible_number(body: pl.Foundation) -> None:
    case = pl.Case(body, pl.Sphere("0.5 mm"), force="5 MN", elements=32)
    with pytest.warns(pl.NotCertifiedWarning, match="beyond-model, do not use these numbers.* times its radius"):
        path = case.solve()
    assert path.status == path[0].status == "beyond-model"
    assert path[0].certificate


def test_results_have_readable_representations(path: pl.Path) -> None:
    assert repr(path) == "<Path 'two loads': 2 steps, certified>"
    assert re.match(r"<Step 0: Q = 5\.0000 mN, D = [0-9.]+ nm, certified>", repr(path[0])), repr(path[0])
    assert path._repr_html_().count("<tr>") == 3
    assert "<td>certified</td>" in path[0]._repr_html_()


def test_a_path_is_a_page_a_table_and_a_picture(path: pl.Path, tmp_path: Path) -> None:
    page = path.report(tmp_path / "page.html")
    assert "two loads" in page and page.count("<svg") >= 3
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == page
    with pytest.raises(pl.ArgumentError, match="report: found a path from a pickle"):
        pickle.loads(pickle.dumps(path)).report()
    table = path.to_pandas()
    assert list(table["force [N]"]) == [step.force for step in path]
    errors = [step.grid_error.penetration for step in path]
    assert list(table["penetration resolved"]) == [error is not None and error.resolved for error in errors]
    axes = path.plot()
    assert axes.get_xlabel() == "penetration D" and axes.get_title() == "two loads"
    assert path[:1][0].plot().get_xlabel() == "x"


def test_an_oblong_cell_has_arrays_of_its_shape() -> None:
    rubber = pl.Foundation("rigid", [pl.Layer(1.0, pl.Material(1.0, 0.3))])
    x, y = np.meshgrid(np.arange(30) / 30, np.arange(20) / 20, indexing="ij")
    heights = 0.01 * np.cos(2 * np.pi * x) * np.cos(2 * np.pi * y)
    cell = {"sides": [3.0, 2.0], "boundary": "periodic"}
    rough = pl.IndenterMap(heights, sides=(3.0, 2.0))
    case = pl.Case(rubber, rough, pressure=1e-3, elements=[48, 32], **cell)  # type: ignore[arg-type]
    step = case.solve()[0]
    assert step.pressure.shape == step.gap.shape == (48, 32)
    assert (step.x.size, step.y.size) == (48, 32)
    assert abs(step.force / 6e-3 - 1) < 1e-12
    assert step.nominal_pressure is not None and abs(step.nominal_pressure / 1e-3 - 1) < 1e-12
    assert np.array_equal(pickle.loads(pickle.dumps(step)).x, step.x)
    depth = pl.Case(rubber, rough, penetration=step.penetration, elements=48, **cell).solve()[0]  # type: ignore[arg-type]
    # The tolerance of the solver.
    assert abs(depth.force / step.force - 1) < 1e-7
