"""From a resolved case to an OpenFOAM case: mesh, start fields, dictionaries. Nothing in it is edited by hand."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np

from .blocks import block_counts
from .case_folder import CaseFolder
from .errors import Refused
from .foam_files import boundary_section, dictionary, entry, header, scalar_list, vector_list, write_dictionary, write_field
from .grid import Grid, make_grid
from .mesh_files import write_mesh
from .moving_mesh import Window
from .resolved_case import NARROWEST_MUSHY_RANGE, SIDES, ResolvedCase
from .volume_fractions import contains, top_of_bodies, volume_fractions

# Numerics of the reference, the same for every case. Reasons: README.md, section Numerics.
NUMERICS = {
    "time_step_factor": 1.0,
    "courant_limit": 0.5,
    "interface_courant_limit": 0.3,
    "height_functions": True,
    "curvature_smoothing_passes": 4,
    "curvature_averaging_passes": 1,
    "momentum_predictor": True,
    "pressure_correctors": 2,
    "temperature_tolerance": 0.5,
    "energy_iterations": 25,
    "ray_tracing": False,
}
PATCH_TYPES = {"wall": "wall", "symmetry": "symmetryPlane", "open": "patch", "periodic": "cyclic"}
TEMPERATURE = "[0 0 0 1 0 0 0]"
BETWEEN_RANKS = {'"procBoundary.*"': {"type": "processor"}}          # in every field; without effect in a serial case


def write_case(case: ResolvedCase, folder: Path, ranks: int = 1, grid: Grid | None = None, fraction: np.ndarray | None = None,
               window: Window | None = None) -> CaseFolder:
    """Write the OpenFOAM case of a resolved case into `folder`, divided among at most `ranks` ranks.

    grid and fraction (n,): made here if they are not given; window: of a mesh that follows the beam.
    Errors: Refused for a bed file that cannot be read.
    """
    grid = grid or make_grid(case, top_of_bodies(case))
    written = CaseFolder(folder, grid, block_counts(case, grid, ranks))
    fraction = volume_fractions(case, grid) if fraction is None else fraction
    write_frame(case, written, window)
    for part, block in written.parts():
        _write_start_fields(case, block, written.part(fraction, block), part/"0")
    return written


def write_frame(case: ResolvedCase, written: CaseFolder, window: Window | None = None) -> None:
    """Write everything of a case but its fields: meshes, properties, control, and the description of its grid."""
    for part, block in written.parts():
        write_mesh(block, patch_types(case), part)
    _write_properties(case, written.path, window)
    _write_system(written.path, "flow" in case.physics)
    if written.ranks > 1:
        write_dictionary(written.path/"system"/"decomposeParDict", {"numberOfSubdomains": written.ranks, "method": "manual"})
    written.save()


def boundary_sections(case: ResolvedCase, scratch: Path) -> dict[str, str]:
    """Text of boundaryField of each start field by its name, for fields on another mesh (scratch: a folder for a moment).

    Only for cases whose sides have uniform values, as those with a beam have.
    """
    one_cell = Grid(*(np.array([a, b], dtype=float) for a, b in zip(case.lower, case.upper)), False)
    _write_start_fields(case, one_cell, np.zeros(1), scratch)
    sections = {path.name: boundary_section(path) for path in scratch.iterdir()}
    shutil.rmtree(scratch)
    return sections


def calculated_boundaries(case: ResolvedCase) -> str:
    """Text of boundaryField of a field that has no conditions of its own."""
    conditions = {side: {"type": "calculated", "value": "uniform 0"} if kind in ("wall", "patch") else {"type": kind}
                  for side, kind in patch_types(case).items()}
    return dictionary({"boundaryField": conditions | BETWEEN_RANKS})


def patch_types(case: ResolvedCase) -> dict[str, str]:
    """OpenFOAM's patch type of each side."""
    return {side: "empty" if case.is_planar and side.startswith("y") else PATCH_TYPES[case.boundaries[side]["kind"]]
            for side in SIDES}


def start_temperature(case: ResolvedCase, positions: np.ndarray) -> np.ndarray:
    """Temperature at the start (n,) K at positions (n, 3) m: of the uppermost body there that has one of its own, else
    initial.temperature + gradient . (x - domain.lower) + hot spot; exactly solid or liquid where it is the melting point."""
    initial = case.data["initial"]
    origin = np.array(case.lower, dtype=float)
    if case.is_planar:
        origin[1] = 0.0
    field = initial["temperature"] + (positions - origin) @ np.array(initial["temperature_gradient"], dtype=float)
    spot = initial.get("hot_spot")
    if spot:
        square = ((positions[:, :2] - np.array(spot["center"][:2], dtype=float))**2).sum(axis=1)
        field = field + spot["rise"]*np.exp(-2*square/spot["radius"]**2)
    temperature = field.copy()
    solidus, liquidus = case.melting_range if "melting" in case.physics else (np.inf, -np.inf)
    for body in case.data["bodies"]:
        here = contains(body, positions, case.is_planar)
        own = body.get("temperature")
        temperature[here] = field[here] if own is None else own
        if body["material"] == case.primary_name and liquidus - solidus <= NARROWEST_MUSHY_RANGE*(1 + 1e-9):
            melting = here & (temperature >= solidus) & (temperature <= liquidus)
            temperature[melting] = solidus if body["state"] == "solid" else liquidus
    return temperature


def start_velocity(case: ResolvedCase, positions: np.ndarray) -> np.ndarray | None:
    """Velocity at the start (n, 3) m/s at positions (n, 3) m; None at rest. Taylor-Green: U (sin kx cos kz, 0, -cos kx sin kz)."""
    field = case.data["initial"].get("velocity")
    if not field:
        return None
    if field["field"] != "taylor_green":
        raise Refused(f"{case.path}: initial.velocity.field: this solver knows taylor_green, not '{field['field']}'")
    wave_number = 2*np.pi/field["wavelength"]
    x, z = wave_number*positions[:, 0], wave_number*positions[:, 2]
    return field["speed"]*np.column_stack([np.sin(x)*np.cos(z), np.zeros(len(x)), -np.cos(x)*np.sin(z)])


def _boundary(case: ResolvedCase, wall, opening: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Boundary conditions of a field: `wall(side)` and `opening` by kind of side; the rest follow from the patch type."""
    conditions = {}
    for side, patch_type in patch_types(case).items():
        if patch_type == "wall":
            conditions[side] = wall(side)
        elif patch_type == "patch":
            conditions[side] = opening
        else:
            conditions[side] = {"type": patch_type}
    return conditions | BETWEEN_RANKS


def _write_start_fields(case: ResolvedCase, grid: Grid, fraction: np.ndarray, folder: Path) -> None:
    wetting = "wetting" in case.physics
    write_field(folder/"fraction", "volScalarField", "[0 0 0 0 0 0 0]", scalar_list(fraction), _boundary(
        case,
        lambda side: {"type": "fixedGradient", "gradient": "uniform 0"} if wetting else {"type": "zeroGradient"},
        _inflow(case, 0.0)))
    if "flow" in case.physics:
        velocity = start_velocity(case, grid.cell_centres())
        write_field(folder/"U", "volVectorField", "[0 1 -1 0 0 0 0]", "uniform (0 0 0)" if velocity is None else vector_list(velocity), _boundary(
            case, lambda side: _wall_velocity(case, side), {"type": "pressureInletOutletVelocity", "value": "uniform (0 0 0)"}))
        write_field(folder/"p_rgh", "volScalarField", "[1 -1 -2 0 0 0 0]", "uniform 0", _boundary(
            case, lambda side: {"type": "fixedFluxPressure", "value": "uniform 0"},
            {"type": "totalPressure", "rho": "density", "p0": "uniform 0", "value": "uniform 0"}))
    if "heat" in case.physics:
        write_field(folder/"T", "volScalarField", TEMPERATURE, scalar_list(start_temperature(case, grid.cell_centres())),
                    _boundary(case, lambda side: _wall_temperature(case, side), _inflow(case, ambient_temperature(case))))
    elif case.has_temperature:
        # frozen: the linear field up to the sides, so that its gradient is exact in the cells along them
        conditions = {}
        for side, patch_type in patch_types(case).items():
            values = scalar_list(start_temperature(case, grid.side_centres(side)))
            conditions[side] = {"type": "fixedValue", "value": values} if patch_type in ("wall", "patch") else {"type": patch_type}
        write_field(folder/"T", "volScalarField", TEMPERATURE, scalar_list(start_temperature(case, grid.cell_centres())),
                    conditions | BETWEEN_RANKS)


def _inflow(case: ResolvedCase, value: float) -> dict[str, Any]:
    """An open side: what flows in has `value`, what flows out its own; nothing passes where nothing flows."""
    if "flow" not in case.physics:
        return {"type": "zeroGradient"}
    return {"type": "inletOutlet", "inletValue": f"uniform {value!r}", "value": f"uniform {value!r}"}


def _wall_velocity(case: ResolvedCase, side: str) -> dict[str, Any]:
    boundary = case.boundaries[side]
    if boundary.get("slip", "no_slip") != "no_slip":
        return {"type": "slip"}
    velocity = [float(part) for part in boundary.get("velocity") or (0.0, 0.0, 0.0)]
    return {"type": "fixedValue", "value": "uniform " + entry(velocity)} if any(velocity) else {"type": "noSlip"}


def _wall_temperature(case: ResolvedCase, side: str) -> dict[str, Any]:
    temperature = case.boundaries[side].get("temperature")
    if temperature is None:
        return {"type": "zeroGradient"}
    return {"type": "fixedValue", "value": f"uniform {float(temperature)!r}"}


def ambient_temperature(case: ResolvedCase) -> float:
    """Temperature far away [K]."""
    return float((case.data.get("surrounding") or {}).get("temperature", case.data["initial"]["temperature"]))


def _primary_entries(case: ResolvedCase) -> dict[str, Any]:
    known = ("density", "viscosity", "specific_heat", "specific_heat_solid", "conductivity", "conductivity_solid", "solidus",
             "liquidus", "latent_heat", "mushy_drag", "surface_tension", "surface_tension_slope",
             "surface_tension_reference_temperature", "surface_tension_minimum", "contact_angle", "boiling_temperature",
             "vaporization_heat", "molar_mass", "emissivity")
    entries = {"melts": "melting" in case.physics}
    entries |= {key: float(case.primary[key]) for key in known if key in case.primary}
    if not entries["melts"] and "specific_heat" in entries:
        # one state for ever: that of the bodies
        solid = any(body["state"] == "solid" for body in case.data["bodies"] if body["material"] == case.primary_name)
        for key in ("specific_heat", "conductivity"):
            entries[key] = entries[f"{key}_solid"] = entries.get(f"{key}_solid", entries[key]) if solid else entries[key]
    elif entries["melts"]:
        for key in ("specific_heat", "conductivity"):
            entries.setdefault(f"{key}_solid", entries[key])
        entries["solidus"], entries["liquidus"] = case.melting_range
    return entries


# Keys of [numerics] and [numerics.openfoam] that override the above.
OVERRIDES = {"time_step_factor": "time_step_factor"}
OWN_OVERRIDES = {"max_courant": "courant_limit", "max_alpha_courant": "interface_courant_limit",
                 "curvature_smoothing": "curvature_smoothing_passes", "ray_tracing": "ray_tracing"}


def numerics(case: ResolvedCase) -> dict[str, Any]:
    """The reference's numerics, with what the case overrides."""
    given, own = case.data["numerics"], case.data["numerics"].get("openfoam") or {}
    result = dict(NUMERICS)
    for source, names in ((given, OVERRIDES), (own, OWN_OVERRIDES)):
        result |= {ours: source[name] for name, ours in names.items() if source.get(name) is not None}
    return result


def _write_properties(case: ResolvedCase, folder: Path, window: Window | None) -> None:
    surrounding = case.data.get("surrounding") or {}
    entries: dict[str, Any] = {
        "physics": case.physics,
        "primary": _primary_entries(case),
        "surrounding": {key: float(case.surrounding[key]) for key in ("density", "viscosity", "specific_heat", "conductivity")
                        if key in case.surrounding},
        "ambient_temperature": ambient_temperature(case),
        "ambient_pressure": float(surrounding.get("pressure", 101325.0)),
        "convection_coefficient": float(surrounding.get("convection_coefficient", 0.0)) if "radiation" in case.physics else 0.0,
        "end_time": case.end,
        "output_interval": case.output_interval,
        "spacing": case.spacing,
        "numerics": numerics(case),
    }
    if window is not None:
        entries["mesh_window"] = window.entries()
    if "laser" in case.physics:
        laser = case.data["laser"]
        entries["laser"] = {key: float(laser[key]) for key in ("power", "speed", "spot_radius", "absorptivity", "start")}
        entries["laser"] |= {end: [float(value) for value in laser["path"][end]] + [0.0] for end in ("from", "to")}
    write_dictionary(folder/"constant"/"cupelProperties", entries)
    if "gravity" in case.physics:
        gravity = "(" + " ".join(repr(float(value)) for value in case.data["gravity"]) + ")"
        (folder/"constant"/"g").write_text(
            header("uniformDimensionedVectorField", "g") + f"dimensions [0 1 -2 0 0 0 0];\nvalue {gravity};\n")


def _write_system(folder: Path, flow: bool) -> None:
    """Control, schemes and linear solvers: the same for every case (without flow the energy matrix is symmetric)."""
    energy = {"solver": "PBiCGStab", "preconditioner": "DILU"} if flow else {"solver": "PCG", "preconditioner": "DIC"}
    system = folder/"system"
    # the solver keeps its own clock: OpenFOAM's end and write times never come
    write_dictionary(system/"controlDict", {
        "application": "cupel_foam", "startFrom": "latestTime", "startTime": 0, "stopAt": "endTime", "endTime": 1e30,
        "deltaT": 1e-9, "writeControl": "timeStep", "writeInterval": 2000000000, "purgeWrite": 0, "writeFormat": "binary",
        "writePrecision": 17, "writeCompression": "off", "timeFormat": "general", "timePrecision": 12,
        "runTimeModifiable": False})
    write_dictionary(system/"fvSchemes", {
        "ddtSchemes": {"default": "Euler"},
        "gradSchemes": {"default": "Gauss linear"},
        "divSchemes": {"default": "Gauss linear", "div(mass_flux,U)": "Gauss limitedLinearV 1",
                       "div(phi,enthalpy)": "Gauss limitedLinear 1", "div(phi,enthalpy_upwind)": "Gauss upwind"},
        "laplacianSchemes": {"default": "Gauss linear orthogonal"},
        "interpolationSchemes": {"default": "linear"},
        "snGradSchemes": {"default": "orthogonal"}})
    pressure = {"solver": "PCG", "preconditioner": "DIC", "tolerance": 1e-8, "relTol": 0.001, "maxIter": 500}
    write_dictionary(system/"fvSolution", {
        "solvers": {
            "p_rgh": pressure,
            "p_rghFinal": pressure | {"tolerance": 1e-9, "relTol": 0.0},
            "U": {"solver": "smoothSolver", "smoother": "symGaussSeidel", "tolerance": 1e-8, "relTol": 0.0},
            "T": energy | {"tolerance": 1e-14, "relTol": 1e-8}},
        "PISO": {"p_rghRefCell": 0, "p_rghRefValue": 0}})
