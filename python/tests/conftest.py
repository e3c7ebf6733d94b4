"""The body and cases shared by the tests. Nothing is cached on disk or written outside the test's folder."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

os.environ["PELLICLE_CACHE"] = ""

import pytest

import pellicle as pl


@pytest.fixture
def body() -> pl.Foundation:
    """A hard coating on a polymer."""
    return pl.Foundation(pl.Material("3 GPa", 0.35), [pl.Layer("2 um", pl.Material("200 GPa", 0.25))])


@pytest.fixture
def case(body: pl.Foundation) -> pl.Case:
    """Two loads of a ball on a hard coating, with few elements."""
    return pl.Case(body, pl.Sphere("0.5 mm"), forces=["5 mN", "50 mN"], elements=32, title="two loads")


@pytest.fixture(scope="session")
def unit() -> Any:
    """Pint's units."""
    return pytest.importorskip("pint").UnitRegistry()


@pytest.fixture(scope="session")
def program() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs the command `pellicle` that cargo has built for tests."""
    path = Path(__file__).resolve().parents[2] / "target" / "debug" / "pellicle"

    def run(*arguments: object) -> subprocess.CompletedProcess[str]:
        words = [str(path), *map(str, arguments)]
        return subprocess.run(words, check=True, capture_output=True, text=True)

    return run
