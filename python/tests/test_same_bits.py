"""Python and `pellicle run` give the same results to the last bit."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pellicle as pl
from pellicle import toml

Program = Callable[..., object]

CASES = sorted((Path(__file__).resolve().parents[2] / "cases").glob("*.toml"))


def without_times(summary: dict[str, Any]) -> dict[str, Any]:
    """A summary without the entries that differ between runs: times, and the origin of coefficients."""
    steps = [step | {"work": step["work"] | {"seconds": None}} for step in summary["steps"]]
    return summary | {"timing": None, "steps": steps}


def check(path: pl.Path, file: Path, program: Program, folder: Path) -> None:
    """Runs the file with the command and compares summary, curve and fields."""
    out = folder / "results"
    program("run", file, "--out", out, "--quiet", "--fields", "all", "--pictures", "none", "--threads", 1)
    summary = json.loads((out / "summary.json").read_text())
    assert without_times(path.summary)["steps"] == without_times(summary)["steps"]
    assert [warning.code for warning in path.warnings] == [warning["code"] for warning in summary["warnings"]]
    assert pl.Case.from_toml(file).solve().summary["warnings"] == summary["warnings"]
    assert pl.Curve.of_csv((out / "curve.csv").read_text()).keys() == path.curve.keys()
    for i, step in enumerate(path):
        with np.load(out / f"fields-{i:03}.npz") as fields:
            for name in ("pressure", "displacement", "gap", "shortening", "profile", "mask", "contact", "x", "y"):
                assert np.array_equal(getattr(step, name), fields[name]), name


@pytest.mark.filterwarnings("ignore::pellicle.NotCertifiedWarning")
@pytest.mark.parametrize("file", CASES, ids=lambda file: file.stem)
def test_cases_of_the_repository_give_the_same_bits(file: Path, program: Program, tmp_path: Path) -> None:
    # Few elements and no stresses, which take long and do not differ between Python and the command.
    few = {"grid.elements": 64, "output": {"formats": ["npz"], "fields": "all", "pictures": "none"}}
    case = pl.Case.from_toml(file).replaced(few)
    document = {key: value for key, value in tomllib.loads(case.to_toml()).items() if key != "stress"}
    few_file = tmp_path / file.name
    few_file.write_text(toml.text(document))
    check(pl.Case.from_toml(few_file).solve(threads=2), few_file, program, tmp_path)


def test_a_case_built_of_arrays_gives_the_same_bits(body: pl.Foundation, program: Program, tmp_path: Path) -> None:
    x = np.linspace(-4e-6, 4e-6, 41)[:, None]
    y = np.linspace(-4e-6, 4e-6, 37)[None, :]
    tip = pl.IndenterMap((x**2 + 1.7 * y**2) / 2e-5, sides=(8.2e-6, 8e-6))
    waves = pl.Rough(3e-9 * np.cos(2e6 * x) * np.cos(3e6 * y), sides=("8.2 um", "8 um"))
    case = pl.Case(body, tip, surface=waves, forces=["0.1 mN", "0.5 mN"], side="5 um", elements=48)
    case.to_toml(tmp_path / "maps.toml")
    check(case.solve(), tmp_path / "maps.toml", program, tmp_path)


def test_stresses_and_sensitivities_give_the_same_bits(body: pl.Foundation, program: Program, tmp_path: Path) -> None:
    strong = pl.Foundation(
        pl.Material("3 GPa", 0.35, yield_strength="0.1 GPa"), [pl.Layer("2 um", pl.Material("200 GPa", 0.25))]
    )
    case = pl.Case(
        strong, pl.Sphere("0.5 mm"), forces=["5 mN", "50 mN"], elements=32, sensitivities=True, stress=pl.Stress()
    )
    case.to_toml(tmp_path / "stress.toml")
    path = case.solve()
    assert path.summary["critical"] is not None
    assert path[0].summary["sensitivities"] is not None
    check(path, tmp_path / "stress.toml", program, tmp_path)
