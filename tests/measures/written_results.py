"""Writes snapshots as the solvers do: VTK XML, appended and compressed, with a PVD series and a run.json."""

import json

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

FIELDS = ("volume", "fraction", "temperature", "velocity", "pressure", "liquid_fraction", "peak_temperature")


def write_elements(elements, path):
    """Particles to .vtp (point data), cells to .vtu (hexahedra, cell data); fields that are None are left out."""
    points = vtk.vtkPoints()
    if elements.extent is None:
        data, writer = vtk.vtkPolyData(), vtk.vtkXMLPolyDataWriter()
        points.SetData(numpy_to_vtk(np.ascontiguousarray(elements.position), deep=True))
        attributes = data.GetPointData()
    else:
        data, writer = vtk.vtkUnstructuredGrid(), vtk.vtkXMLUnstructuredGridWriter()
        signs = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])
        corners = elements.position[:, None, :] + 0.5 * signs * elements.extent[:, None, :]
        points.SetData(numpy_to_vtk(corners.reshape(-1, 3), deep=True))
        hexahedra = vtk.vtkCellArray()
        ids = np.arange(8 * elements.count, dtype=np.int64)
        hexahedra.SetData(numpy_to_vtkIdTypeArray(np.arange(0, len(ids) + 1, 8, dtype=np.int64), deep=True),
                          numpy_to_vtkIdTypeArray(ids, deep=True))
        data.SetCells(vtk.VTK_HEXAHEDRON, hexahedra)
        attributes = data.GetCellData()
    data.SetPoints(points)
    for name in FIELDS:
        values = getattr(elements, name)
        if values is not None:
            array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
            array.SetName(name)
            attributes.AddArray(array)
    writer.SetFileName(str(path))
    writer.SetInputData(data)
    writer.SetDataModeToAppended()
    assert writer.Write() == 1


def write_result(folder, snapshots, run=None):
    """fields/ with one file a snapshot (at its time) and fields.pvd, and run.json if given."""
    fields = folder / "fields"
    fields.mkdir(parents=True)
    entries = []
    for index, elements in enumerate(snapshots):
        name = f"fields_{index:06d}.{'vtp' if elements.extent is None else 'vtu'}"
        write_elements(elements, fields / name)
        entries.append(f'<DataSet timestep="{elements.time!r}" group="" part="0" file="{name}"/>')
    (fields / "fields.pvd").write_text(
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n'
        + "\n".join(entries) + "\n</Collection>\n</VTKFile>\n")
    if run is not None:
        (folder / "run.json").write_text(json.dumps(run))
    return folder
