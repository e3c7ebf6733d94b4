"""Reads fields-nN.nc of a study with xarray: the case as a dimension, the forces of the table, missing values."""

import csv
import sys
from pathlib import Path

import numpy as np
import xarray

folder = Path(sys.argv[1])
rows = {int(row["case"]): row for row in csv.DictReader((folder / "results.csv").open())}
seen = set()
for size in [32, 48]:
    with xarray.open_dataset(folder / f"fields-n{size}.nc", engine="scipy") as data:
        assert data.pressure.dims == ("case", "x", "y") and data.pressure.shape[1:] == (size, size)
        assert data.pressure.attrs["units"] == "Pa" and data.side.attrs["units"] == "m"
        assert np.allclose(data.x * size, np.arange(size) + 0.5 - size / 2)
        for i, case in enumerate(data.case.values.tolist()):
            row, pressure = rows[case], data.pressure.values[i]
            seen.add(case)
            if row["status"] == "failed":
                assert data.status.values[i] == 3 and np.isnan(pressure).all() and np.isnan(data.side.values[i])
                continue
            assert data.status.values[i] == 0
            side = float(row["domain side [m]"])
            assert data.side.values[i] == side
            assert pressure.max() == float(row["max pressure [Pa]"])
            assert np.isclose(pressure.sum() * (side / size) ** 2, float(row["force [N]"]), rtol=1e-8)
assert seen == set(rows)
