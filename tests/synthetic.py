"""Synthetic results: small folders as a solver leaves them, with fields given by formulas.

They stand in for solver output where the tests are about what comes after it (results, comparison, report). Nothing
here is a reference for physics: drops are exact caps, the melt pool is the smoothed point source below.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

BED = Path(__file__).resolve().parents[1] / "validation_cases" / "common" / "bed_seed1.csv"
STEEL = {
    "density": 6900, "density_solid": 7200, "viscosity": 6e-3, "specific_heat": 780, "specific_heat_solid": 700,
    "conductivity": 18.1, "conductivity_solid": 36.7, "solidus": 1673, "liquidus": 1773, "melting_temperature": 1723,
    "latent_heat": 247000, "surface_tension": 1.2, "surface_tension_slope": -4.3e-4, "contact_angle": 0.785398,
    "boiling_temperature": 3050, "emissivity": 0.6, "absorptivity": 0.35,
}


def wall(**more) -> dict:
    return {"kind": "wall", "slip": "no_slip", "temperature": None} | more


def with_hash(case: dict) -> dict:
    """The case with the hash of its content, as the case reader gives it."""
    text = json.dumps({key: value for key, value in case.items() if key != "hash"}, sort_keys=True)
    return case | {"hash": hashlib.sha256(text.encode()).hexdigest()}


def resolved_drop(spacing: float = 2e-4) -> dict:
    """A resolved case like droplet_wetting."""
    angle = np.pi / 4
    return with_hash({
        "schema": 1, "name": "droplet_wetting", "title": "Oil drop wetting a wall in water at 45°",
        "paper": ["figure 1", "figure 2", "figure 3"], "case_file": "validation_cases/droplet_wetting/case.toml",
        "level": "coarse", "spacing": spacing, "dimensions": 3, "physics": ["flow", "surface_tension", "wetting"],
        "materials": {"oil": {"density": 900, "viscosity": 0.05, "surface_tension": 0.050475, "contact_angle": angle},
                      "water": {"density": 1000, "viscosity": 0.001}},
        "surrounding": {"material": "water", "resolved": True},
        "domain": {"lower": [-2.4e-3, -2.4e-3, 0], "upper": [2.4e-3, 2.4e-3, 2.4e-3],
                   "boundaries": {side: wall() for side in ("x_min", "x_max", "y_min", "y_max", "z_min", "z_max")}},
        "gravity": [0, 0, 0], "initial": {"temperature": 300, "temperature_gradient": [0, 0, 0]},
        "bodies": [{"shape": "sphere", "material": "oil", "state": "liquid", "center": [0, 0, 1e-3], "radius": 1e-3}],
        "laser": None, "time": {"end": 0.15, "output_interval": 0.01},
        "measures": [
            {"name": "contact_angle", "between": [0.12, 0.15], "tolerance": np.radians(5), "metric": "absolute",
             "unit": "rad", "reference": {"kind": "exact", "value": angle, "source": "prescribed angle"}},
            {"name": "base_radius", "between": [0.12, 0.15], "tolerance": 0.06, "metric": "relative", "unit": "m",
             "reference": {"kind": "exact", "value": 1.8261e-3, "source": "spherical cap of the drop's volume"}},
            {"name": "apex_height", "between": [0.12, 0.15], "tolerance": 0.06, "metric": "relative", "unit": "m",
             "reference": {"kind": "exact", "value": 0.7564e-3, "source": "spherical cap of the drop's volume"}}],
        "numerics": {},
        "assumed": [{"key": "body.radius", "value": 1e-3, "unit": "m", "reason": "the paper gives none"},
                    {"key": "material.oil.viscosity", "value": 0.05, "unit": "Pa s", "reason": "the paper gives none"}],
        "powder": None,
    })


def resolved_layer(spacing: float = 5e-5) -> dict:
    """A resolved case like marangoni_layer."""
    return with_hash({
        "schema": 1, "name": "marangoni_layer", "title": "Thermocapillary return flow in a closed layer", "paper": [],
        "case_file": "validation_cases/marangoni_layer/case.toml", "level": "coarse", "spacing": spacing, "dimensions": 2,
        "physics": ["flow", "surface_tension", "marangoni"],
        "materials": {"liquid": {"density": 1000, "viscosity": 0.05, "surface_tension": 0.05,
                                 "surface_tension_slope": -1e-4}},
        "surrounding": {"material": "gas", "resolved": False},
        "domain": {"lower": [0, 0, 0], "upper": [1e-2, 0, 1e-3],
                   "boundaries": {side: wall() for side in ("x_min", "x_max", "z_min", "z_max")}},
        "gravity": [0, 0, 0], "initial": {"temperature": 300, "temperature_gradient": [1000, 0, 0]},
        "bodies": [{"shape": "box", "material": "liquid", "state": "liquid", "lower": [0, 0, 0], "upper": [1e-2, 0, 1e-3]}],
        "laser": None, "time": {"end": 0.4, "output_interval": 0.1},
        "measures": [{"name": "profile_error", "between": [0.3, 0.4], "tolerance": 0.03, "metric": "absolute", "unit": "1",
                      "reference": {"kind": "exact", "value": 0.0, "source": "u = (τH/4μ)(3η² − 2η)"}}],
        "numerics": {}, "assumed": [], "powder": None,
    })


def resolved_track(power: float, spacing: float = 4e-5) -> dict:
    """A resolved case like slm_track_150w."""
    reference = {"kind": "solver", "solver": "openfoam", "value": None, "source": "the reference solver of this suite"}
    return with_hash({
        "schema": 1, "name": f"slm_track_{power:g}w", "title": f"Single track on a random powder bed, 304L, {power:g} W",
        "paper": ["figure 4", "figure 5", "figure 6", "figure 7", "figure 8", "figure 9"],
        "case_file": f"validation_cases/slm_track_{power:g}w/case.toml", "level": "coarse", "spacing": spacing,
        "dimensions": 3, "physics": ["flow", "surface_tension", "wetting", "marangoni", "recoil", "evaporation",
                                     "radiation", "laser", "heat", "melting"],
        "materials": {"steel": STEEL}, "surrounding": {"material": "argon", "resolved": False},
        "domain": {"lower": [0, -3.6e-4, -3.6e-4], "upper": [1.6e-3, 3.6e-4, 2e-4],
                   "boundaries": {side: wall() for side in ("x_min", "x_max", "y_min", "y_max", "z_min")}
                   | {"z_max": {"kind": "open", "temperature": None}}},
        "gravity": [0, 0, 0], "initial": {"temperature": 300, "temperature_gradient": [0, 0, 0]},
        "bodies": [{"shape": "box", "material": "steel", "state": "solid", "lower": [0, -3.6e-4, -3.6e-4],
                    "upper": [1.6e-3, 3.6e-4, 0]},
                   {"shape": "powder_bed", "material": "steel", "state": "solid", "file": str(BED),
                    "lower": [0, -3.6e-4, 0], "upper": [1.6e-3, 3.6e-4, 5e-5]}],
        "laser": {"power": power, "speed": 0.15, "spot_radius": 8e-5, "absorptivity": 0.35,
                  "path": {"from": [3e-4, 0], "to": [1.3e-3, 0]}, "start": 0.0},
        "time": {"end": 6.6e-3, "output_interval": 2.2e-3},
        "measures": [{"name": name, "between": [3e-3, 6.6e-3], "reference": reference, "tolerance": 0.1,
                      "metric": "relative", "unit": "m"} for name in ("melt_pool_width", "melt_pool_depth")],
        "numerics": {},
        "assumed": [{"key": "laser.spot_diameter", "value": 1.6e-4, "unit": "m", "reason": "conduction regime"},
                    {"key": "material.steel.viscosity", "value": 6e-3, "unit": "Pa s", "reason": "published 3e-3 to 7e-3"}],
        "powder": {"seed": 1},
    })


def lattice(case: dict, grow: bool) -> np.ndarray:
    """Element centres (n, 3) [m] of the case's domain on its spacing."""
    domain, spacing = case["domain"], case["spacing"]
    axes = []
    for axis, (lower, upper) in enumerate(zip(domain["lower"], domain["upper"])):
        count = max(1, round((upper - lower) / spacing)) if case["dimensions"] == 3 or axis != 1 else 1
        start = lower if count > 1 else lower - 0.5 * spacing
        axes.append(start + (np.arange(count + (2 if grow and axis == 2 else 0)) + 0.5) * spacing)
    return np.stack([grid.ravel() for grid in np.meshgrid(*axes, indexing="ij")], axis=1)


def drop_fields(case: dict, position: np.ndarray, time: float, bias: float) -> dict:
    """A cap that goes from a sphere to 45° by time 0.1 s; `bias` changes its size."""
    settled = min(1.0, time / 0.1)
    radius = (1e-3 + settled * 1.5825e-3) * (1 + bias)
    centre = (1 - settled) * 1e-3 - settled * (radius - 0.7564e-3)
    inside = np.linalg.norm(position - [0, 0, centre], axis=1) < radius
    velocity = np.zeros_like(position)
    velocity[:, 0] = 0.02 * (1 - settled) * position[:, 0] / 1e-3
    velocity[:, 2] = -0.02 * (1 - settled) * position[:, 2] / 1e-3
    return {"fraction": inside.astype(float), "velocity": velocity, "pressure": 80.0 * inside}


def layer_fields(case: dict, position: np.ndarray, time: float, bias: float) -> dict:
    """The exact return flow, scaled by 1 + bias, reached within 0.2 s."""
    eta = position[:, 2] / 1e-3
    speed = 0.1 * 1e-3 / (4 * 0.05) * (1 + bias) * min(1.0, time / 0.2)
    velocity = np.zeros_like(position)
    velocity[:, 0] = -speed * (3 * eta**2 - 2 * eta)
    velocity *= (np.minimum(position[:, :1], 1e-2 - position[:, :1]) > 1e-3)
    return {"fraction": (position[:, 2] < 1e-3).astype(float), "velocity": velocity,
            "temperature": 300 + 1000 * position[:, 0]}


def track_fields(case: dict, position: np.ndarray, time: float, bias: float) -> dict:
    """A moving point source smoothed over the spot, on a plate with a rough layer of grains."""
    laser = case["laser"]
    random = np.random.default_rng(1)
    grains = np.column_stack([random.uniform(0, 1.6e-3, 160), random.uniform(-3.6e-4, 3.6e-4, 160)])

    def temperature_at(moment: float) -> np.ndarray:
        relative = position - [laser["path"]["from"][0] + laser["speed"] * moment, 0, 0]
        distance = np.sqrt((relative**2).sum(axis=1) + (0.6 * laser["spot_radius"])**2)
        strength = 0.35 * laser["power"] * (1 + bias) / (2 * np.pi * 30)
        rise = strength / distance * np.exp(-laser["speed"] * (distance + relative[:, 0]) / (2 * 5e-6))
        return 300 + rise * (1 - np.exp(-moment / 5e-4))

    temperature = temperature_at(time)
    peak = np.max([temperature_at(moment) for moment in np.linspace(0, time, 12)], axis=0)
    fraction = (position[:, 2] < 0).astype(float)
    low = (position[:, 2] >= 0) & (position[:, 2] < 6e-5)
    near = np.min(np.linalg.norm(position[low][:, None, :2] - grains[None], axis=2), axis=1)
    fraction[low] = ((near < 2.5e-5) | (peak[low] > 1723)).astype(float)
    velocity = np.zeros_like(position)
    liquid = np.clip((temperature - 1673) / 100, 0, 1) * fraction
    velocity[:, 1] = 0.5 * liquid * np.sign(position[:, 1])
    velocity[:, 0] = -0.3 * liquid
    return {"fraction": fraction, "velocity": velocity, "temperature": temperature, "peak_temperature": peak,
            "liquid_fraction": liquid}


def fields_of(case: dict):
    """The formula of a case's fields."""
    if case["laser"]:
        return track_fields
    return drop_fields if case["dimensions"] == 3 else layer_fields


def hexahedra(position: np.ndarray, spacing: float) -> vtkUnstructuredGrid:
    """Cubic cells around `position` (n, 3) that share their corners."""
    offsets = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    start = position.min(axis=0) - 0.5 * spacing
    corners = (np.rint((position - start) / spacing - 0.5).astype(np.int64)[:, None] + offsets[None]).reshape(-1, 3)
    unique, number = np.unique(corners, axis=0, return_inverse=True)
    points, cells, grid = vtkPoints(), vtkCellArray(), vtkUnstructuredGrid()
    points.SetData(numpy_to_vtk(start + spacing * unique, deep=True))
    rows = np.column_stack([np.full(len(position), 8), number.reshape(-1, 8)]).astype(np.int64)
    cells.SetCells(len(position), numpy_to_vtkIdTypeArray(rows.ravel(), deep=True))
    grid.SetPoints(points)
    grid.SetCells(VTK_HEXAHEDRON, cells)
    return grid


def write_snapshot(path: Path, solver: str, position: np.ndarray, spacing: float, fields: dict) -> None:
    """Points (.vtp) for particles, hexahedra (.vtu) for cells, through VTK's own writers."""
    if solver == "sph":
        grid = vtkPolyData()
        points = vtkPoints()
        points.SetData(numpy_to_vtk(position, deep=True))
        grid.SetPoints(points)
        data, writer = grid.GetPointData(), vtkXMLPolyDataWriter()
    else:
        grid = hexahedra(position, spacing)
        data, writer = grid.GetCellData(), vtkXMLUnstructuredGridWriter()
    for name, values in fields.items():
        array = numpy_to_vtk(np.ascontiguousarray(values, dtype=float), deep=True)
        array.SetName(name)
        data.AddArray(array)
    writer.SetFileName(str(path))
    writer.SetInputData(grid)
    writer.SetDataModeToAppended()
    writer.Write()


def write_fields(folder: Path, solver: str, case: dict, bias: float) -> None:
    """The snapshots of a run with their series."""
    position = lattice(case, grow=False)
    if solver == "sph" and not case["surrounding"]["resolved"]:
        keep = fields_of(case)(case, position, case["time"]["end"], bias)["fraction"] > 0.5
        position = position[keep]
    interval = case["time"]["output_interval"]
    times = np.arange(round(case["time"]["end"] / interval) + 1) * interval
    (folder / "fields").mkdir(parents=True)
    entries = []
    for number, time in enumerate(times):
        name = f"fields_{number:06d}.{'vtp' if solver == 'sph' else 'vtu'}"
        fields = fields_of(case)(case, position, time, bias)
        fields["volume"] = np.full(len(position), case["spacing"] ** 3)
        write_snapshot(folder / "fields" / name, solver, position, case["spacing"], fields)
        entries.append(f'<DataSet timestep="{time:.9g}" group="" part="0" file="{name}"/>')
    (folder / "fields" / "fields.pvd").write_text(
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1"><Collection>\n' + "\n".join(entries)
        + "\n</Collection></VTKFile>\n")


def run_record(case: dict, solver: str) -> dict:
    """A run.json of a completed run."""
    ledgers = {"mass": {"start": 1.0, "end": 1.0, "in": 0.0, "out": 0.0, "closure": 1e-12}}
    if case["laser"]:
        ledgers["energy"] = {"start": 0.0, "end": 0.31, "in": 0.35, "out": 0.04, "closure": 4e-6, "laser_emitted": 1.0,
                             "laser_absorbed": 0.35, "absorbed_error": 2e-5}
    else:
        ledgers["volume"] = {"start": 1.0, "end": 1.0, "in": 0.0, "out": 0.0, "closure": 2e-4}
    return {
        "schema": 1, "case": case["name"], "solver": solver, "variant": case["level"], "status": "completed",
        "diagnosis": "", "code": {"version": "0.1.0", "commit": "0123456789ab", "reference_version": None},
        "host": {"name": "synthetic", "cpu": "none", "cores": 2}, "settings": case, "ledgers": ledgers,
        "cost": {"wall_s": 61.0, "cpu_s": 60.0, "threads": 1, "steps": 1200, "elements": 42000,
                 "updates_per_core_s": 8.3e5, "peak_bytes": 2.5e8, "time_step_binding": {"acoustic": 1100, "capillary": 100}},
    }


def write_run(folder: Path, solver: str, case: dict, bias: float = 0.0) -> None:
    """A folder as a solver leaves it: launch record, resolved case, snapshots, history, and the account last."""
    write_fields(folder, solver, case, bias)
    (folder / "case.json").write_text(json.dumps(case))
    launch = {"case": case["name"], "solver": solver, "variant": case["level"], "hash": case["hash"], "fingerprint": "none"}
    (folder / "launch.json").write_text(json.dumps(launch))
    (folder / "history.csv").write_text("time_s,kinetic_energy_J\n0,0\n1e-3,1e-9\n2e-3,2e-9\n")
    (folder / "run.json").write_text(json.dumps(run_record(case, solver)))
