"""Reads stress-NNN.nc with xarray.

Coordinates, units, the stresses on the surface, the tractions and jumps at an interface, and the derived stresses.
"""

import json
import sys
from pathlib import Path

import numpy as np
import xarray

folder = Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
stress = summary["case"]["stress"]
friction = stress["friction"] * np.array([np.cos(stress["direction"]), np.sin(stress["direction"])])
thickness = [layer["thickness"] for layer in summary["case"]["foundation"]["layer"]]
displacements, stresses = ["ux", "uy", "uz"], ["sxx", "syy", "szz", "sxy", "sxz", "syz"]
for step, numbers in enumerate(summary["steps"]):
    fields = np.load(folder / f"fields-{step:03}.npz")
    with xarray.open_dataset(folder / f"stress-{step:03}.nc", engine="scipy") as data:
        assert data.attrs["title"] == summary["title"]
        assert data.attrs["force"] == numbers["force"]
        assert data.attrs["friction"] == stress["friction"]
        assert data.attrs["bodies"].split() == [f"layer[{i}]" for i in range(len(thickness))] + ["substrate"]
        for name in displacements + stresses + ["von_mises", "max_principal"]:
            assert data[name].dims == ("z", "x", "y") and data[name].dtype == np.float64, name
            assert data[name].attrs["units"] == ("m" if name in displacements else "Pa"), name
            assert np.isfinite(data[name]).all(), name
        x, y, z = (data[name].values for name in "xyz")
        shown = np.abs(fields["x"]) <= 1.5 * numbers["contact_radius"] * (1 + 1e-12)
        assert np.array_equal(x, fields["x"][shown]) and np.array_equal(y, x)
        assert z[0] == 0 and np.isclose(z[-1], 2 * numbers["contact_radius"], rtol=1e-15, atol=0)
        assert (np.diff(z) >= 0).all() and len(set(z)) == len(z) - len(thickness)
        # The surface carries the pressure and the friction; the fields are exact to 1e-11 of the largest.
        pressure = fields["pressure"][np.ix_(shown, shown)]
        bound = 1e-10 * pressure.max()
        surface = data.isel(z=0)
        for name, traction in [("szz", 1), ("sxz", friction[0]), ("syz", friction[1])]:
            assert np.abs(surface[name] + traction * pressure).max() <= bound, name
        # Tractions and displacements are continuous across a bonded interface; the stress along it jumps.
        bottoms = np.cumsum(thickness)
        for i, bottom in enumerate(bottoms):
            above, below = np.flatnonzero(np.isclose(z, bottom, rtol=1e-12, atol=0))
            assert (data["body"][above], data["body"][below]) == (i, i + 1)
            above, below = data.isel(z=above), data.isel(z=below)
            for name in displacements + ["szz", "sxz", "syz"]:
                assert np.abs(above[name] - below[name]).max() <= 1e-9 * np.abs(data[name]).max(), name
            assert np.abs(above["sxx"] - below["sxx"]).max() > 0.1 * np.abs(above["sxx"]).max()
        inside = z < bottoms[0]
        assert (data["body"][inside] == 0).all() and (data["body"][z > bottoms[-1]] == len(bottoms)).all()
        # Von Mises and principal stresses, computed in another way.
        xx, yy, zz, xy, xz, yz = (data[name].values for name in stresses)
        tensor = np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=-1).reshape(*xx.shape, 3, 3)
        deviator = tensor - np.trace(tensor, axis1=-2, axis2=-1)[..., None, None] / 3 * np.eye(3)
        von_mises = np.sqrt(1.5 * (deviator**2).sum(axis=(-2, -1)))
        scale = np.abs(tensor).max()
        assert np.abs(data["von_mises"].values - von_mises).max() <= 1e-13 * scale
        assert np.abs(data["max_principal"].values - np.linalg.eigvalsh(tensor)[..., 2]).max() <= 1e-13 * scale
