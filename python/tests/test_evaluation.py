"""Unloadings evaluated by Oliver and Pharr, and curves fitted each alone, the same as by the command."""

from __future__ import annotations

import json
import math
import pickle
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pellicle as pl

Program = Callable[..., "subprocess.CompletedProcess[str]"]

BASE = "foundation.substrate.young_modulus"
E_IT, POISSON, EXPONENT = 72e9, 0.17, 1.4
DIAMOND = (1141e9, 0.07)


def indentation(contact_depth: float) -> dict[str, Any]:
    """A load and its unloading by an ideal Berkovich pyramid, by the formulas of Oliver and Pharr solved backwards."""
    reduced = 1 / ((1 - POISSON**2) / E_IT + (1 - DIAMOND[1] ** 2) / DIAMOND[0])
    # Area and angle of the pyramid of 65.27°: 24.494 h².
    area = 3 * math.sqrt(3) * math.tan(math.radians(65.27)) ** 2 * contact_depth**2
    force, stiffness = 9e9 * area, 2 / math.sqrt(math.pi) * reduced * math.sqrt(area)
    deepest = contact_depth + 0.75 * force / stiffness
    left = deepest - EXPONENT * force / stiffness
    up, down = np.linspace(0, 1, 200), np.linspace(1, 0, 200)
    depth = np.concatenate([deepest * np.sqrt(up), left + (deepest - left) * down[1:]])
    return {"depth": depth, "force": force * np.concatenate([up, down[1:] ** EXPONENT])}


@pytest.fixture(scope="module")
def evaluation() -> pl.Evaluation:
    curves = [pl.Data.of_arrays(**indentation(depth), name=f"{depth}.csv") for depth in (200e-9, 400e-9)]
    return pl.evaluate(curves, pl.OliverPharr(POISSON, tip="berkovich", drift="off", depth_zero="as recorded"))


def test_modulus_and_hardness_are_those_of_the_formulas(evaluation: pl.Evaluation) -> None:
    assert evaluation.verdict == "evaluated" and evaluation.table["contact_depth"] == pytest.approx([200e-9, 400e-9], rel=1e-4)
    assert evaluation.table["indentation_modulus"] == pytest.approx([E_IT, E_IT], rel=1e-3)
    assert evaluation.table["indentation_hardness"] == pytest.approx([9e9, 9e9], rel=1e-3)
    assert "E_IT" in str(evaluation) and "2 contacts" in repr(evaluation) and "<td>" in evaluation._repr_html_()
    assert pickle.loads(pickle.dumps(evaluation)) == evaluation and evaluation.calibration is None


def test_a_file_gives_what_the_program_gives(evaluation: pl.Evaluation, program: Program, tmp_path: Path) -> None:
    curve = indentation(200e-9)
    rows = (f"{depth!r},{force!r}" for depth, force in zip(*(curve[of].tolist() for of in ("depth", "force")), strict=True))
    (tmp_path / "curve.csv").write_text("\n".join(["h,F", *rows]))
    text = """
[[data]]
file = "curve.csv"
columns = { depth = "h", force = "F" }
units = { depth = "m", force = "N" }
observe = "unloading"
[evaluation]
tip = "berkovich"
poisson_ratio = 0.17
drift = "off"
depth_zero = "as recorded"
"""
    (tmp_path / "glass.toml").write_text(text)
    found = pl.evaluate(tmp_path / "glass.toml")
    assert found.to_dict() == json.loads(program("identify", tmp_path / "glass.toml", "--json").stdout)
    assert found.table["indentation_modulus"][0] == evaluation.table["indentation_modulus"][0]
    with pytest.raises(pl.ArgumentError, match=r"pellicle\.evaluate"):
        pl.identify(tmp_path / "glass.toml")


def test_a_calibration_is_a_file_of_another_evaluation(tmp_path: Path) -> None:
    curves = [pl.Data.of_arrays(**indentation(depth), name=f"{depth}.csv") for depth in np.linspace(1e-7, 6e-7, 6)]
    known = pl.KnownBody(E_IT, coefficients=1)
    found = pl.evaluate(curves, pl.OliverPharr(POISSON, drift="off", depth_zero="as recorded", calibrate=known))
    assert found.calibration is not None
    (tmp_path / "tip.toml").write_text(found.calibration)
    options = pl.OliverPharr(POISSON, area_function=str(tmp_path / "tip.toml"), drift="off", depth_zero="as recorded")
    assert pl.evaluate(curves[2], options).table["indentation_modulus"][0] == pytest.approx(E_IT, rel=1e-3)


def test_what_is_no_evaluation_is_refused(tmp_path: Path) -> None:
    curve = pl.Data.of_arrays(**indentation(200e-9))
    wrong: Any = "berkovich"
    with pytest.raises(pl.ArgumentError, match="evaluation: found str, wanted a pellicle.OliverPharr"):
        pl.evaluate(curve, wrong)
    with pytest.raises(pl.CaseError, match="area_function"):
        pl.evaluate(curve, pl.OliverPharr(POISSON))
    with pytest.raises(pl.CaseError, match="tip_radius"):
        pl.evaluate(curve, pl.OliverPharr(POISSON, tip="sphere"))


def test_a_fit_of_stiffnesses_of_unloadings_takes_the_evaluation() -> None:
    body = pl.Foundation(pl.Material("60 GPa", POISSON))
    model = pl.Case(body, pl.Cone("70.3 deg", young_modulus=DIAMOND[0], poisson_ratio=DIAMOND[1]), force="1 mN")
    curves = [pl.Data.of_arrays(**indentation(depth), observe="unloading", name=f"{depth}") for depth in (2e-7, 4e-7)]
    options = pl.OliverPharr(POISSON, tip="berkovich", drift="off", depth_zero="as recorded")
    found = pl.identify(pl.Fit(model, curves, unknown={BASE: ("20 GPa", "200 GPa")}, evaluation=options))
    assert found[BASE].value == pytest.approx(E_IT, rel=1e-3)


def test_each_curve_alone_is_what_the_program_finds(program: Program, tmp_path: Path) -> None:
    body = pl.Foundation(pl.Material("10 GPa", 0.3))
    model = pl.Case(body, pl.Paraboloid("10 um"), forces=pl.Range("0.1 mN", "5 mN", 20, "log"), elements=64)
    solved = model.solve()
    force, depth = np.array(solved.curve["force"]), np.array(solved.curve["penetration"])
    noise = np.random.default_rng(1).normal(0, 2e-10, (3, 20))
    curves = [
        pl.Data.of_arrays(force=force, depth=depth + of, noise=pl.Noise(depth="0.2 nm"), name=f"{k}.csv")
        for k, of in enumerate(noise)
    ]
    fit = pl.Fit(model, curves, unknown={BASE: ("2 GPa", "50 GPa")}, title="map")
    found = pl.identify_each(fit)
    assert [curve["verdict"] for curve in found.curves] == ["fitted"] * 3
    values = found.table[BASE]
    assert np.abs(values / 10e9 - 1).max() < 0.05 and "3 of 3 fitted" in repr(found)
    fit.to_toml(tmp_path / "map.toml")
    theirs = json.loads(program("identify", tmp_path / "map.toml", "--each", "--json").stdout)
    assert [curve["unknowns"] for curve in theirs["curves"]] == [curve["unknowns"] for curve in found.curves]
