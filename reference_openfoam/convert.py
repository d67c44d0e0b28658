"""Snapshots: OpenFOAM time folders to VTK files (cell data) and the series that ParaView opens."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, vtkCellArray, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from .case_folder import CaseFolder
from .grid import Grid
from .resolved_case import ResolvedCase


def snapshot_time(case: ResolvedCase, index: int) -> float:
    """Time of snapshot `index` [s]: a multiple of the output interval, the last one the end."""
    return min(index*case.output_interval, case.end)


def snapshot_index(case: ResolvedCase, time: float) -> int | None:
    """Which snapshot a written time is; None for a checkpoint between snapshots."""
    last = int(np.ceil(case.end/case.output_interval - 1e-6))
    index = last if time > case.end - 1e-6*case.output_interval else round(time/case.output_interval)
    return index if abs(snapshot_time(case, index) - time) < 1e-6*case.output_interval else None


def liquid_fraction(case: ResolvedCase, temperature: np.ndarray | None, cells: int) -> np.ndarray:
    """Liquid fraction of the primary material (n,), linear between solidus and liquidus; 1 where nothing melts."""
    if "melting" not in case.physics or temperature is None:
        return np.ones(cells)
    solidus, liquidus = case.melting_range
    return np.clip((temperature - solidus)/(liquidus - solidus), 0, 1)


class SnapshotWriter:
    """Writes the VTK files of one run into `folder`; keeps the mesh as long as it stays the same."""

    def __init__(self, case: ResolvedCase, folder: Path):
        self.case, self.folder = case, folder
        self.grid: Grid | None = None
        folder.mkdir(parents=True, exist_ok=True)

    def _take_mesh(self, grid: Grid) -> None:
        if grid is self.grid:
            return
        self.grid, self.volumes = grid, grid.cell_volumes()
        self.mesh = vtkUnstructuredGrid()
        points = vtkPoints()
        points.SetDataTypeToDouble()
        self._point_data = grid.points()
        points.SetData(numpy_to_vtk(self._point_data))
        self.mesh.SetPoints(points)
        corners = grid.cell_corners()
        cells = vtkCellArray()
        cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 8*len(corners) + 1, 8, dtype=np.int64), deep=True),
                      numpy_to_vtkIdTypeArray(corners.ravel().astype(np.int64), deep=True))
        self.mesh.SetCells(VTK_HEXAHEDRON, cells)

    def fields(self, written: CaseFolder, time: str) -> dict[str, np.ndarray]:
        """The fields of a written time by their names in a result, (n,) or (n, 3), SI."""
        case, cells = self.case, self.grid.cell_count
        fraction = written.read(time, "fraction")
        density = fraction*case.primary["density"] + (1 - fraction)*case.surrounding["density"]
        result = {"fraction": np.clip(fraction, 0, 1), "volume": self.volumes, "density": density}
        temperature = None
        if case.has_temperature:
            temperature = result["temperature"] = written.read(time, "T")
        if "heat" in case.physics:
            result["peak_temperature"] = written.read(time, "peak_temperature")
        if "flow" in case.physics:
            result["velocity"] = written.read(time, "U")
            height = self.grid.cell_centres() @ np.array(case.data["gravity"]) if "gravity" in case.physics else 0.0
            result["pressure"] = written.read(time, "p_rgh") + density*height
        result["liquid_fraction"] = liquid_fraction(case, temperature, cells)
        return result

    def write(self, written: CaseFolder, time: str, index: int) -> Path:
        """Write snapshot `index` from a written time; beside its name first, then renamed."""
        self._take_mesh(written.grid)
        data = self.mesh.GetCellData()
        data.Initialize()
        for name, values in self.fields(written, time).items():
            array = numpy_to_vtk(np.ascontiguousarray(values, dtype=np.float64 if name == "volume" else np.float32), deep=True)
            array.SetName(name)
            data.AddArray(array)
        final = self.folder/f"fields_{index:06d}.vtu"
        part = final.with_suffix(".part")
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(str(part))
        writer.SetInputData(self.mesh)
        writer.SetDataModeToAppended()
        writer.SetCompressorTypeToZLib()
        if writer.Write() != 1:
            raise OSError(f"{final}: cannot be written")
        part.replace(final)
        self.write_series()
        return final

    def write_series(self) -> None:
        """Write fields.pvd from the snapshots that are there."""
        lines = []
        for path in sorted(self.folder.glob("fields_*.vtu")):
            index = int(re.fullmatch(r"fields_(\d+)\.vtu", path.name).group(1))
            lines.append(f'    <DataSet timestep="{snapshot_time(self.case, index):.12g}" group="" part="0" file="{path.name}"/>\n')
        part = self.folder/"fields.pvd.part"
        part.write_text('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n  <Collection>\n'
                        + "".join(lines) + "  </Collection>\n</VTKFile>\n")
        part.replace(self.folder/"fields.pvd")
