"""The value of a key at which a number of the result meets its limit."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

import pellicle as pl


def ball(**more: Any) -> pl.Case:
    return pl.Case(pl.Foundation(pl.Material("206 GPa", 0.3)), pl.Paraboloid("5 mm"), force="1 N", elements=64, **more)


def test_the_largest_force_below_a_pressure_is_that_of_hertz() -> None:
    found = pl.find(ball(), "max_pressure < 1 GPa", by="load.force")
    modulus = 206e9 / (1 - 0.3**2)
    exact = math.pi**3 * 5e-3**2 * 1e9**3 / (6 * modulus**2)
    assert found.extreme == "largest" and found.verdict == "found"
    assert found.interval is not None and found.interval[0] <= exact <= found.interval[1]
    assert len(found.cases["case"]) <= 8
    assert repr(found).startswith("<Found largest load.force = 2.52")


def test_the_answer_is_that_of_the_program(tmp_path: Path, program: Any) -> None:
    case = ball(title="ball")
    case.to_toml(tmp_path / "ball.toml")
    asked = ("--find", "contact_area > 1e-9", "--by", "load.force")
    program("study", tmp_path / "ball.toml", *asked, "--quiet", "--out", tmp_path / "found")
    written = json.loads((tmp_path / "found/find.json").read_text())
    found = pl.find(case, "contact_area > 1e-9", by="load.force", threads=1)
    assert found.value == written["value"] and list(found.interval or ()) == written["interval"]


def test_without_an_answer_a_warning_says_why() -> None:
    with pytest.warns(pl.StudyWarning, match="holds at both ends"):
        found = pl.find(ball(), "max_pressure < 30 GPa", by="load.force", between=["0.5 N", 1.0])
    assert found.value is None and found.verdict == "holds-at-both-ends"


@pytest.mark.parametrize(
    ("condition", "by", "between"),
    [
        ("max_presure < 1 GPa", "load.force", None),
        ("max_pressure < 1 um", "load.force", None),
        ("max_pressure < 1 GPa", "grid.elements", None),
        ("max_pressure < 1 GPa", "load.force", ["1 um", "2 um"]),
    ],
)
def test_a_wrong_question_is_a_case_error(condition: str, by: str, between: Any) -> None:
    with pytest.raises(pl.CaseError, match="found .*, wanted"):
        pl.find(ball(), condition, by=by, between=between)
