"""Small resolved cases for the tests of the OpenFOAM reference, in the form that `cupel_case resolve` prints."""

from __future__ import annotations

import copy
import csv
import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
STEEL = {"density": 6900.0, "density_solid": 7200.0, "viscosity": 6e-3, "specific_heat": 780.0, "specific_heat_solid": 700.0,
         "conductivity": 18.14, "conductivity_solid": 36.71, "solidus": 1673.0, "liquidus": 1773.0, "melting_temperature": 1723.0,
         "latent_heat": 247000.0, "mushy_drag": 1e13, "surface_tension": 1.2, "surface_tension_slope": -4.3e-4,
         "surface_tension_reference_temperature": 1723.0, "surface_tension_minimum": 0.1, "contact_angle": 0.785398,
         "boiling_temperature": 3050.0, "vaporization_heat": 6.1e6, "molar_mass": 0.0558, "emissivity": 0.6, "absorptivity": 0.35}
ARGON = {"density": 1.62, "viscosity": 2.2e-5, "specific_heat": 520.0, "conductivity": 0.018}
EVERYTHING = ["flow", "surface_tension", "wetting", "marangoni", "recoil", "evaporation", "radiation", "laser", "heat", "melting"]
WALL = {"kind": "wall", "slip": "no_slip", "temperature": None}
OPEN = {"kind": "open", "temperature": None}


def boundaries(**sides: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Adiabatic walls all round, but for the sides that are named."""
    return {side: dict(WALL) for side in ("x_min", "x_max", "y_min", "y_max", "z_min", "z_max")} | sides


def case(**parts: Any) -> dict[str, Any]:
    """A resolved case with the given parts; the rest are what a case without them would have."""
    data = {"schema": 1, "name": "small", "title": "a test", "paper": [], "case_file": "case.toml", "level": "coarse", "dimensions": 3,
            "gravity": None, "initial": {"temperature": 300.0, "temperature_gradient": [0.0, 0.0, 0.0]}, "laser": None, "measures": [],
            "numerics": {}, "assumed": [], "powder": None, "surrounding": None}
    data |= copy.deepcopy(parts)
    data["hash"] = hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()
    return data


def argon_surrounding() -> dict[str, Any]:
    return {"material": "argon", "resolved": False, "temperature": 300.0, "pressure": 101325.0, "convection_coefficient": 0.0}


def grain_on_plate(**changes: Any) -> dict[str, Any]:
    """A plate with one grain under a beam at rest, all physics, 16 x 16 x 13 cells, 20 steps or so."""
    parts = dict(
        spacing=2e-5, physics=EVERYTHING, materials={"steel": STEEL, "argon": ARGON}, surrounding=argon_surrounding(),
        domain={"lower": [0.0, -1.6e-4, -1.2e-4], "upper": [3.2e-4, 1.6e-4, 1.4e-4], "boundaries": boundaries(z_max=OPEN)},
        bodies=[{"shape": "box", "material": "steel", "state": "solid", "lower": [0.0, -1.6e-4, -1.2e-4], "upper": [3.2e-4, 1.6e-4, 0.0]},
                {"shape": "sphere", "material": "steel", "state": "solid", "center": [1.6e-4, 0.0, 3e-5], "radius": 3e-5}],
        laser={"power": 150.0, "speed": 0.15, "spot_radius": 8e-5, "absorptivity": 0.35, "start": 0.0,
               "path": {"from": [1.4e-4, 0.0], "to": [2.4e-4, 0.0]}},
        time={"end": 6e-5, "output_interval": 2e-5})
    return case(**(parts | changes))


def solve(data: dict[str, Any], folder: Path, *options: str) -> subprocess.CompletedProcess:
    """Run the reference on a case in `folder`/result through its command line."""
    file = folder/"resolved.json"
    file.write_text(json.dumps(data))
    return subprocess.run([sys.executable, "-m", "reference_openfoam", "run", str(file), "--output", str(folder/"result"), *options],
                          env=os.environ | {"PYTHONPATH": str(ROOT)}, capture_output=True, text=True, timeout=120)


def completed(data: dict[str, Any], folder: Path, *options: str) -> dict[str, Any]:
    """Run to completion; returns run.json."""
    result = solve(data, folder, *options)
    assert result.returncode == 0, result.stderr
    return json.loads((folder/"result"/"run.json").read_text())


def last_fields(data: dict[str, Any], folder: Path) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Fields of the last snapshot and cell centres (n, 3), read from the VTK file."""
    return fields_of(folder, -1)


def fields_of(folder: Path, snapshot: int) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """The same of any snapshot by its number."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(sorted((folder/"result"/"fields").glob("*.vtu"))[snapshot]))
    reader.Update()
    mesh = reader.GetOutput()
    corners = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 8)
    centres = vtk_to_numpy(mesh.GetPoints().GetData())[corners].mean(axis=1)
    cells = mesh.GetCellData()
    fields = {cells.GetArrayName(i): vtk_to_numpy(cells.GetArray(i)).astype(float) for i in range(cells.GetNumberOfArrays())}
    return fields, centres


def history(folder: Path) -> dict[str, np.ndarray]:
    """Columns of history.csv."""
    with open(folder/"result"/"history.csv", newline="") as stream:
        rows = list(csv.reader(stream))
    return {name: np.array([float(row[index]) for row in rows[1:]]) for index, name in enumerate(rows[0])}
