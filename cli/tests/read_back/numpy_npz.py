"""Reads fields-NNN.npz with NumPy: names, shapes, and the force as the sum of the pressure."""

import json
import sys
from pathlib import Path

import numpy as np

folder = Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
size, side = summary["grid"]["elements"], summary["grid"]["side"]
for step, numbers in enumerate(summary["steps"]):
    fields = np.load(folder / f"fields-{step:03}.npz")
    assert fields["x"].shape == fields["y"].shape == (size,)
    for name in ["pressure", "displacement", "gap", "shortening", "profile", "mask", "contact"]:
        assert fields[name].shape == (size, size), name
    assert np.array_equal(fields["contact"], fields["pressure"] > 0)
    force = fields["pressure"].sum() * (side / size) ** 2
    # Summed in a different order from the program: size² roundings.
    assert abs(force / numbers["force"] - 1) < 1e-11, (force, numbers["force"])
    i, j = np.unravel_index(fields["pressure"].argmax(), (size, size))
    assert [fields["x"][i], fields["y"][j]] == numbers["max_pressure_at"]
