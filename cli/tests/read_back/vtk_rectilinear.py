"""Reads stress-NNN.vtr with VTK, ParaView's own reader.

The points, every array along x first, and its unit; the values are those of stress-NNN.nc.
"""

import json
import sys
from pathlib import Path

import numpy as np
import xarray
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkIOXML import vtkXMLRectilinearGridReader

folder = Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
names = ["ux", "uy", "uz", "sxx", "syy", "szz", "sxy", "sxz", "syz", "von_mises", "max_principal"]
for step in range(len(summary["steps"])):
    reader = vtkXMLRectilinearGridReader()
    reader.SetFileName(str(folder / f"stress-{step:03}.vtr"))
    reader.Update()
    assert reader.GetErrorCode() == 0
    grid = reader.GetOutput()
    points = grid.GetPointData()
    with xarray.open_dataset(folder / f"stress-{step:03}.nc", engine="scipy") as data:
        coordinates = [grid.GetXCoordinates(), grid.GetYCoordinates(), grid.GetZCoordinates()]
        for name, found in zip("xyz", coordinates):
            assert np.array_equal(vtk_to_numpy(found), data[name].values), name
        assert points.GetNumberOfArrays() == len(names) + 1
        for name in names:
            array = points.GetArray(name)
            wanted = data[name].transpose("z", "y", "x").values.astype(np.float32)
            assert np.array_equal(vtk_to_numpy(array), wanted.ravel()), name
            assert array.GetInformation().Get(vtkDataArray.UNITS_LABEL()) == data[name].attrs["units"], name
        body = np.broadcast_to(data["body"].values[:, None, None], data["uz"].shape)
        assert np.array_equal(vtk_to_numpy(points.GetArray("body")), body.ravel())
        assert points.GetScalars().GetName() == "von_mises"
