"""Reads fields-NNN.nc with xarray, as the results of contact.engineering are read.

Dimensions, variables, units, attributes.
"""

import json
import sys
from pathlib import Path

import numpy as np
import xarray

folder = Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
area = summary["grid"]["side"] ** 2
units = dict(x="m", y="m", pressure="Pa", displacement="m", gap="m", shortening="m", profile="m")
for step, numbers in enumerate(summary["steps"]):
    fields = np.load(folder / f"fields-{step:03}.npz")
    with xarray.open_dataset(folder / f"fields-{step:03}.nc", engine="scipy") as data:
        for name, unit in units.items():
            assert np.array_equal(data[name].values, fields[name]), name
            assert data[name].attrs["units"] == unit, name
            assert name in "xy" or data[name].dims == ("x", "y"), name
        points = data["contacting_points"]
        assert points.dtype == bool and np.array_equal(points.values, fields["pressure"] > 0)
        for name in ["mask", "contact"]:
            assert data[name].dtype == bool and np.array_equal(data[name].values, fields[name]), name
        assert data.attrs["type"] == "nonperiodic"
        assert data.attrs["title"] == summary["title"]
        assert data.attrs["mean_pressure"] == numbers["mean_pressure"]
        assert np.isclose(data.attrs["nominal_pressure"], numbers["force"] / area, rtol=1e-15)
        assert np.isclose(data.attrs["total_contact_area"], numbers["contact_area"] / area, rtol=1e-15)
        assert data.attrs["penetration"] == numbers["penetration"]
