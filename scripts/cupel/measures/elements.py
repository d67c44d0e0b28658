"""Elements: what a measure sees of a snapshot, be it of SPH particles or of finite-volume cells.

An element is a small piece of matter with a position, a volume and a share `fraction` of the primary
(non-surrounding) material. SPH writes points (.vtp), OpenFOAM writes cells (.vtu); once read, nothing asks which.
"""

from __future__ import annotations

import xml.etree.ElementTree
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

from .registry import MeasureError

OPTIONAL_FIELDS = ("temperature", "velocity", "pressure", "liquid_fraction", "peak_temperature")


@dataclass(frozen=True)
class Elements:
    """Particles or cells of one instant, SI units; n elements.

    position (n, 3) m, volume (n) m^3, fraction (n) 0..1, time s; optional, None where the snapshot has none:
    temperature (n) K, velocity (n, 3) m/s, pressure (n) Pa, liquid_fraction (n) 0..1, peak_temperature (n) K,
    extent (n, 3) m: edges of the box around a cell (None: particles, which have no shape).
    source: the file, for messages.
    """

    position: np.ndarray
    volume: np.ndarray
    fraction: np.ndarray
    time: float = 0.0
    temperature: np.ndarray | None = None
    velocity: np.ndarray | None = None
    pressure: np.ndarray | None = None
    liquid_fraction: np.ndarray | None = None
    peak_temperature: np.ndarray | None = None
    extent: np.ndarray | None = None
    source: str = "snapshot"

    @property
    def count(self) -> int:
        return len(self.volume)

    @property
    def are_cells(self) -> bool:
        return self.extent is not None

    def require(self, *names: str, by: str = "this measure") -> None:
        """Refuse a snapshot without the named fields.

        Errors: MeasureError that names file, field and measure.
        """
        for name in names:
            if getattr(self, name) is None:
                raise MeasureError(f"{self.source}: no field '{name}', which {by} needs; "
                                   f"the case must name physics that computes it")

    def take(self, chosen: np.ndarray) -> Elements:
        """The elements that a mask (n,) or an index array picks, all fields with them."""
        picked = {f.name: getattr(self, f.name)[chosen] for f in fields(self)
                  if isinstance(getattr(self, f.name), np.ndarray)}
        return replace(self, **picked)

    @staticmethod
    def joined(parts: list[Elements]) -> Elements:
        """All parts (pieces of one instant) as one; a field that one part lacks is lacking."""
        if len(parts) == 1:
            return parts[0]
        together = {}
        for f in fields(parts[0]):
            values = [getattr(part, f.name) for part in parts]
            if all(isinstance(value, np.ndarray) for value in values):
                together[f.name] = np.concatenate(values)
            elif f.name not in ("time", "source"):
                together[f.name] = None
        return replace(parts[0], **together)

    def content(self, dimensions: int, spacing: float) -> np.ndarray:
        """Volume (n) m^3 in 3-D; in 2-D the area (n) m^2 in the x-z plane.

        Two-dimensional cells are divided by their thickness. Particles carry either an area (unit thickness) or
        an area times the spacing; whichever is nearer to spacing^2 or spacing^3 is taken.
        """
        if dimensions == 3:
            return self.volume
        if self.extent is not None:
            return self.volume / self.extent[:, 1]
        typical = float(np.median(self.volume))
        is_area = abs(np.log(typical / spacing**2)) <= abs(np.log(typical / spacing**3))
        return self.volume if is_area else self.volume / spacing


@dataclass(frozen=True)
class Series:
    """The snapshots of a run in order of time: `times` (s), and the files of each (read only when asked for)."""

    times: tuple[float, ...]
    files: tuple[tuple[Path, ...], ...]
    fraction_when_absent: float | None = None

    def __len__(self) -> int:
        return len(self.times)

    def __iter__(self) -> Iterator[Elements]:
        return (self.load(index) for index in range(len(self)))

    def load(self, index: int) -> Elements:
        """Snapshot number `index`. Errors: MeasureError if one of its files is missing, truncated or incomplete."""
        parts = [read_elements(path, self.times[index], self.fraction_when_absent) for path in self.files[index]]
        return Elements.joined(parts)


def read_series(result_folder: Path | str, fraction_when_absent: float | None = None) -> Series:
    """The series of RESULT_FOLDER/fields/fields.pvd; no snapshot is opened yet.

    fraction_when_absent: fraction of particles whose file has none (1 where the surrounding has no particles).
    Errors: MeasureError, one line, for a missing, truncated or empty series.
    """
    path = Path(result_folder) / "fields" / "fields.pvd"
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
    except OSError as problem:
        raise MeasureError(f"{path}: cannot be read ({problem.strerror}); run the case first") from None
    except xml.etree.ElementTree.ParseError as problem:
        raise MeasureError(f"{path}: truncated or not a PVD series ({problem}); run the case again") from None
    by_time: dict[float, list[Path]] = {}
    for entry in root.iter("DataSet"):
        try:
            time, name = float(entry.attrib["timestep"]), entry.attrib["file"]
        except (KeyError, ValueError):
            raise MeasureError(f"{path}: a DataSet without a time or a file; run the case again") from None
        by_time.setdefault(time, []).append(path.parent / name)
    if not by_time:
        raise MeasureError(f"{path}: no snapshots in it; run the case again")
    times = tuple(sorted(by_time))
    return Series(times, tuple(tuple(by_time[time]) for time in times), fraction_when_absent)


def read_elements(path: Path | str, time: float = 0.0, fraction_when_absent: float | None = None) -> Elements:
    """One snapshot file: the points of a .vtp or the cells of a .vtu.

    Errors: MeasureError, one line, for a file that is missing, truncated, of another kind, or without
    `volume` or `fraction`, or whose fields hold numbers that are not finite.
    """
    path = Path(path)
    if path.suffix not in (".vtp", ".vtu"):
        raise MeasureError(f"{path}: not a .vtp (particles) or .vtu (cells) file")
    if not path.is_file():
        raise MeasureError(f"{path}: named in the series but missing; run the case again")
    data = _read_vtk(path)
    if path.suffix == ".vtp":
        arrays, position, extent = data.GetPointData(), _points(data), None
    else:
        arrays = data.GetCellData()
        position, extent = _cell_boxes(data)
    if len(position) == 0:
        raise MeasureError(f"{path}: no elements in it; truncated or written by a run that lost everything")

    def array(name: str) -> np.ndarray | None:
        found = arrays.GetArray(name)
        if found is None:
            return None
        values = vtk_to_numpy(found).astype(float)
        if not np.isfinite(values).all():
            raise MeasureError(f"{path}: field '{name}' holds {np.count_nonzero(~np.isfinite(values))} "
                               f"numbers that are not finite; the run went wrong before this snapshot")
        return values

    volume, fraction = array("volume"), array("fraction")
    if fraction is None and extent is None and fraction_when_absent is not None:
        fraction = np.full(len(position), fraction_when_absent)
    for name, values in (("volume", volume), ("fraction", fraction)):
        if values is None:
            raise MeasureError(f"{path}: no field '{name}', which every snapshot must have")
    optional = {name: array(name) for name in OPTIONAL_FIELDS}
    return Elements(position, volume, fraction, float(time), **optional, extent=extent, source=str(path))


def _read_vtk(path: Path):
    """The VTK data set of a file, with VTK's own messages turned into one error line."""
    reader = vtkXMLPolyDataReader() if path.suffix == ".vtp" else vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    before, messages = vtkOutputWindow.GetInstance(), vtkStringOutputWindow()
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(messages)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        reader.Update()
    finally:
        vtkOutputWindow.SetInstance(before)
        vtkLogger.SetStderrVerbosity(verbosity)
    if reader.GetErrorCode() or "ERROR" in messages.GetOutput().upper():
        raise MeasureError(f"{path}: truncated or damaged, cannot be read; run the case again")
    return reader.GetOutput()


def _points(data) -> np.ndarray:
    points = data.GetPoints()
    return vtk_to_numpy(points.GetData()).astype(float) if points is not None else np.zeros((0, 3))


def _cell_boxes(grid) -> tuple[np.ndarray, np.ndarray]:
    """Centre (n, 3) and edge lengths (n, 3) of the box around each cell."""
    points, count = _points(grid), grid.GetNumberOfCells()
    if count == 0:
        return np.zeros((0, 3)), np.zeros((0, 3))
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    corners_of_each = np.diff(offsets)
    if (corners_of_each == corners_of_each[0]).all():
        corners = points[vtk_to_numpy(grid.GetCells().GetConnectivityArray())].reshape(count, -1, 3)
        lower, upper = corners.min(axis=1), corners.max(axis=1)
    else:  # cells of several kinds, as polyhedra between refinement levels
        boxes = np.array([grid.GetCell(index).GetBounds() for index in range(count)])
        lower, upper = boxes[:, 0::2], boxes[:, 1::2]
    return 0.5 * (lower + upper), upper - lower
