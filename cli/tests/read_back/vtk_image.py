"""Reads fields-NNN.vti with VTK, ParaView's own reader: extent, spacing, every array along x first, and its unit."""

import json
import sys
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

folder = Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
size, side = summary["grid"]["elements"], summary["grid"]["side"]
units = dict(pressure="Pa", displacement="m", gap="m", shortening="m", profile="m")
for step in range(len(summary["steps"])):
    fields = np.load(folder / f"fields-{step:03}.npz")
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(folder / f"fields-{step:03}.vti"))
    reader.Update()
    assert reader.GetErrorCode() == 0
    image = reader.GetOutput()
    assert image.GetExtent() == (0, size, 0, size, 0, 0), image.GetExtent()
    assert np.allclose(image.GetOrigin(), [-side / 2, -side / 2, 0], rtol=1e-15)
    assert np.allclose(image.GetSpacing()[:2], side / size, rtol=1e-15)
    cells = image.GetCellData()
    for name, unit in units.items():
        array = cells.GetArray(name)
        found = vtk_to_numpy(array)
        assert np.array_equal(found, fields[name].astype(np.float32).ravel("F")), name
        assert array.GetInformation().Get(vtkDataArray.UNITS_LABEL()) == unit, name
    for name in ["mask", "contact"]:
        assert np.array_equal(vtk_to_numpy(cells.GetArray(name)), fields[name].ravel("F")), name
