"""Three-dimensional views, drawn by VTK on a virtual screen: run as `python3 -m reports.views JOBS.json`.

VTK of this distribution needs an X server, so `draw` starts this module under one (xvfb-run) as a program of its own; a
view that cannot be drawn is left out with a reason, and the page says so.

A job is {"file", "output", "spacing", "colour": "temperature"|"speed"|"peak_temperature"|"diameter"|"material", "range": [low, high],
"box": [[x, y, z], [x, y, z]], "azimuth", "elevation", "zoom", "floor": bool, "colour_map": name}.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

SIZE = (1100, 700)
PATIENCE_S = 20  # a view, of which most take one or two


def draw(jobs: list[dict]) -> str:
    """Draws all jobs; '' if it worked, else why not, in one line. Views that were drawn before a failure stay."""
    if not jobs:
        return ""
    from cupel.layout import PYTHON
    from cupel.solvers import environment

    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(jobs, file)
        file.flush()
        command = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -nolisten tcp", PYTHON, "-m", "reports.views", file.name]
        patience = PATIENCE_S * (2 + len(jobs))
        try:
            process = subprocess.Popen(command, env=environment(1), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                       start_new_session=True)
        except FileNotFoundError:
            return "xvfb-run is not installed"
        try:
            _, messages = process.communicate(timeout=patience)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)  # the virtual screen with it
            process.communicate()
            return f"drawing took longer than {patience} s"
    if process.returncode == 0:
        return ""
    lines = [line for line in messages.splitlines() if line.strip()]
    return lines[-1][:200] if lines else f"the drawing program ended with status {process.returncode}"


def main(path: str) -> int:
    """Draws every job of a file; 0 if all were drawn."""
    failed = 0
    for job in json.loads(Path(path).read_text()):
        try:
            draw_one(job)
        except (RuntimeError, ValueError) as error:
            print(f"{job['output']}: {error}", file=sys.stderr)
            failed += 1
    return 1 if failed else 0


def draw_one(job: dict) -> None:
    """Draws one view into job["output"] (PNG, transparent nowhere, white behind)."""
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (registers the renderer)
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    draw_kind = {".vtp": particles, ".vtu": surface, ".csv": grains}[Path(job["file"]).suffix]
    actor = draw_kind(job)
    renderer.AddActor(actor)
    if job.get("floor"):
        renderer.AddActor(floor(job))
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    add_lights(renderer)
    place_camera(renderer, job)
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.Update()
    writer = vtkPNGWriter()
    writer.SetFileName(job["output"])
    writer.SetInputConnection(picture.GetOutputPort())
    writer.Write()


def read(path: str):
    """The data set of a snapshot; `ValueError` if it cannot be read."""
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

    reader = vtkXMLPolyDataReader() if path.endswith(".vtp") else vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    if data.GetNumberOfPoints() == 0:
        raise ValueError(f"{path} holds nothing to draw")
    return data


def colour_values(arrays, count: int, job: dict) -> np.ndarray:
    """The values (n) that colour a view: a field, the speed, or 1 everywhere for one plain material."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if job["colour"] == "speed":
        return np.linalg.norm(vtk_to_numpy(arrays.GetArray("velocity")), axis=1)
    array = arrays.GetArray(job["colour"]) if job["colour"] != "material" else None
    return vtk_to_numpy(array).astype(float) if array is not None else np.ones(count)


def add_array(arrays, name: str, values: np.ndarray) -> None:
    """Adds a named array to a data set's points or cells."""
    from vtkmodules.util.numpy_support import numpy_to_vtk

    array = numpy_to_vtk(np.ascontiguousarray(values, dtype=float), deep=True)
    array.SetName(name)
    arrays.AddArray(array)


def particles(job: dict):
    """Primary particles as spheres that just touch their neighbours."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    data = read(job["file"])
    arrays = data.GetPointData()
    position = vtk_to_numpy(data.GetPoints().GetData())
    fraction = arrays.GetArray("fraction")
    keep = vtk_to_numpy(fraction) > 0.5 if fraction is not None else np.ones(len(position), bool)
    lower, upper = np.array(job["box"])
    keep &= ((position >= lower) & (position <= upper)).all(axis=1)
    if not keep.any():
        raise ValueError("no particle of the primary material in the box")
    keep[keep] = is_outer(position[keep], job["spacing"])
    colour = colour_values(arrays, len(position), job)[keep]
    return spheres(job, position[keep], np.full(keep.sum(), 0.56 * job["spacing"]), colour)


def is_outer(position: np.ndarray, spacing: float) -> np.ndarray:
    """Which particles (n) can be seen from outside: those that lack neighbours (a full lattice has 26 within 1.8 spacings)."""
    from scipy.spatial import cKDTree

    return cKDTree(position).query_ball_point(position, 1.8 * spacing, return_length=True) - 1 < 26


def grains(job: dict):
    """The spheres of a powder bed (x_m, y_m, z_m, radius_m), coloured by their diameter in μm."""
    rows = [line for line in Path(job["file"]).read_text().splitlines() if line and not line.startswith("#")]
    table = np.loadtxt(rows[1:], delimiter=",", ndmin=2)
    if table.shape[1] != 4 or rows[0].split(",")[3] != "radius_m":
        raise ValueError(f"{job['file']} is no table of spheres")
    return spheres(job, table[:, :3], table[:, 3], 2e6 * table[:, 3])


def spheres(job: dict, position: np.ndarray, radius: np.ndarray, colour: np.ndarray):
    """Spheres at `position` (n, 3) with `radius` (n) [m] and colour values (n), as triangles.

    (VTK's sphere mapper, which draws them in a shader, hangs now and then on a software renderer.)
    """
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkGlyph3D
    from vtkmodules.vtkFiltersSources import vtkSphereSource
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    points, cloud, ball, glyphs = vtkPoints(), vtkPolyData(), vtkSphereSource(), vtkGlyph3D()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(position, dtype=float), deep=True))
    cloud.SetPoints(points)
    add_array(cloud.GetPointData(), "colour", colour)
    add_array(cloud.GetPointData(), "radius", radius)
    ball.SetRadius(1.0)
    ball.SetThetaResolution(12)
    ball.SetPhiResolution(8)
    glyphs.SetInputData(cloud)
    glyphs.SetSourceConnection(ball.GetOutputPort())
    glyphs.SetInputArrayToProcess(0, 0, 0, 0, "radius")
    glyphs.SetScaleModeToScaleByScalar()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(glyphs.GetOutputPort())
    return coloured(vtkActor(), mapper, job)


def surface(job: dict):
    """The part of the cells' domain that holds primary material, cut at fraction 1/2."""
    from vtkmodules.vtkFiltersCore import vtkCellDataToPointData, vtkPolyDataNormals
    from vtkmodules.vtkFiltersGeneral import vtkClipDataSet
    from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    data = read(job["file"])
    add_array(data.GetCellData(), "colour", colour_values(data.GetCellData(), data.GetNumberOfCells(), job))
    points = vtkCellDataToPointData()
    points.SetInputData(data)
    points.Update()
    clip = vtkClipDataSet()
    clip.SetInputConnection(points.GetOutputPort())
    clip.SetInputArrayToProcess(0, 0, 0, 0, "fraction")
    clip.SetValue(0.5)
    skin = vtkDataSetSurfaceFilter()
    skin.SetInputConnection(clip.GetOutputPort())
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(skin.GetOutputPort())
    normals.SetFeatureAngle(50)
    normals.Update()
    if normals.GetOutput().GetNumberOfPoints() == 0:
        raise ValueError("no primary material in the snapshot")
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    return coloured(vtkActor(), mapper, job)


def coloured(actor, mapper, job: dict):
    """Gives an actor its mapper, with colours from a matplotlib colour map over job["range"]."""
    from vtkmodules.vtkCommonCore import vtkLookupTable

    from .colours import colour_map

    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    low, high = job.get("range") or (0.0, 1.0)
    for index, rgba in enumerate(colour_map(job.get("colour_map", "temperature"))(np.linspace(0, 1, 256))):
        table.SetTableValue(index, *rgba)
    table.SetRange(low, high)
    if job["colour"] == "material":
        mapper.ScalarVisibilityOff()
        actor.GetProperty().SetColor(*job.get("plain", (0.86, 0.66, 0.22)))
    else:
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("colour")
        mapper.SetLookupTable(table)
        mapper.SetScalarRange(low, high)
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.25)
    actor.GetProperty().SetDiffuse(0.75)
    actor.GetProperty().SetSpecular(0.12)
    actor.GetProperty().SetSpecularPower(25)
    return actor


def floor(job: dict):
    """The wall below the scene, as a grey sheet."""
    from vtkmodules.vtkFiltersSources import vtkCubeSource
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    (x0, y0, z0), (x1, y1, _) = job["box"]
    sheet = vtkCubeSource()
    sheet.SetBounds(x0, x1, y0, y1, z0 - 0.02 * (x1 - x0), z0)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(sheet.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.72, 0.74, 0.78)
    actor.GetProperty().SetAmbient(0.2)
    actor.GetProperty().SetDiffuse(0.7)
    return actor


def add_lights(renderer) -> None:
    """A key light from above the viewer's left shoulder and a weak one from the right."""
    from vtkmodules.vtkRenderingCore import vtkLight

    for place, strength in (((-0.6, 0.9, 1.0), 0.85), ((1.0, 0.3, 0.6), 0.35)):
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*place)
        light.SetFocalPoint(0, 0, 0)
        light.SetIntensity(strength)
        renderer.AddLight(light)


def place_camera(renderer, job: dict) -> None:
    """Looks at the box from `azimuth` (0: along +y) and `elevation` degrees, so that all of it is in the picture."""
    lower, upper = np.array(job["box"])
    azimuth, elevation = np.radians(job.get("azimuth", -35)), np.radians(job.get("elevation", 35))
    direction = np.array([np.cos(elevation) * np.sin(azimuth), -np.cos(elevation) * np.cos(azimuth), np.sin(elevation)])
    camera = renderer.GetActiveCamera()
    camera.SetViewAngle(18)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(*direction)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera(lower[0], upper[0], lower[1], upper[1], lower[2], upper[2])
    camera.Zoom(job.get("zoom", 1.15))
    renderer.ResetCameraClippingRange()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
