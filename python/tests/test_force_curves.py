"""Curves of force microscopes, read by afmformats and fitted as the document says."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pellicle as pl

DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "python.md"
RADIUS, STIFFNESS, MODULUS = 5e-6, 0.05, 1e4


def test_a_curve_read_by_afmformats_gives_its_modulus(tmp_path: Path) -> None:
    pytest.importorskip("afmformats", reason="the recipe of the document is not tried without it")
    from afmformats.mod_force_distance import AFMForceDistance

    # An approach by Hertz, F = 4/3 E/(1 - ν²) √R D^1.5, 500 nm before the contact, and the way back.
    depth = np.linspace(-5e-7, 3e-7, 400)
    force = 4 / 3 * MODULUS / 0.75 * np.sqrt(RADIUS) * np.maximum(depth, 0.0) ** 1.5
    height = 1e-5 - (depth + force / STIFFNESS)
    noise = np.random.default_rng(1).normal(0, 2e-11, 400)
    columns = {
        "force": np.append(force + noise, force[::-1]),
        "height (measured)": np.append(height, height[::-1]),
        "segment": np.repeat([False, True], 400),
        "time": np.arange(800.0),
    }
    metadata = {"spring constant": STIFFNESS, "imaging mode": "force-distance", "enum": 0, "path": tmp_path / "a.tab"}
    curve = AFMForceDistance(data=columns, metadata=metadata)
    path = tmp_path / "curve.h5"
    curve.export_data(path, metadata=["spring constant", "imaging mode", "enum"], fmt="hdf5")

    text = DOCUMENT.read_text(encoding="utf-8")
    recipe = next(block for block in text.split("```") if "import afmformats" in block)
    names: dict[str, object] = {"pl": pl, "np": np}
    exec(compile(recipe.removeprefix("py\n"), str(DOCUMENT), "exec"), names)
    modulus_of = names["modulus_of"]
    assert callable(modulus_of)
    found = modulus_of(str(path))["foundation.substrate.young_modulus"]
    assert found.interval[0] < MODULUS < found.interval[1]
    assert abs(found.value / MODULUS - 1) < 0.02
