"""The body and cases that tests share. Nothing is cached on disk, and nothing outside the test's folder is written."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

os.environ["PELLICLE_CACHE"] = ""

import pytest

import pellicle as pl

ROOT = Path(__file__).resolve().parents[2]

Program = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture
def body() -> pl.Foundation:
    """A hard coating on a polymer."""
    return pl.Foundation(pl.Material("3 GPa", 0.35), [pl.Layer("2 um", pl.Material("200 GPa", 0.25))])


@pytest.fixture
def case(body: pl.Foundation) -> pl.Case:
    """Two loads of a ball on a hard coating, on few elements."""
    return pl.Case(body, pl.Sphere("0.5 mm"), forces=["5 mN", "50 mN"], elements=32, title="two loads")


@pytest.fixture(scope="session")
def program() -> Program:
    """Runs the command `pellicle`, which `PELLICLE_PROGRAM` names."""
    path = os.environ.get("PELLICLE_PROGRAM", str(ROOT / "target" / "debug" / "pellicle"))

    def run(*arguments: object) -> subprocess.CompletedProcess[str]:
        words = [path, *map(str, arguments)]
        return subprocess.run(words, check=True, capture_output=True, text=True)

    return run
