"""Reads the Gwyddion files with gsffile.

The pressure in single precision, y falling from row to row, extent, units.
"""

import json
import sys
from pathlib import Path

import numpy as np
from gsffile import read_gsf

folder = Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
side = summary["grid"]["side"]
for step in range(len(summary["steps"])):
    fields = np.load(folder / f"fields-{step:03}.npz")
    data, header = read_gsf(folder / f"pressure-{step:03}.gsf")
    assert data.dtype == np.float32
    assert np.array_equal(data, fields["pressure"].T[::-1].astype(np.float32))
    assert header["XReal"] == header["YReal"] == side, header
    assert header["XOffset"] == header["YOffset"] == -side / 2, header
    assert (header["XYUnits"], header["ZUnits"]) == ("m", "Pa"), header
