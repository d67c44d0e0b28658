"""A mesh whose fine cells follow the beam: when they are made anew, and how the fields get from one mesh to the next.

The base grid has cells of the case's spacing throughout. A mesh takes its lines inside a box around beam and melt, and outside
only some of them, so that every coarse cell is made of whole base cells. The solver ends (status 3) when melt comes near the
sides of the box or the beam has travelled on; the next mesh then starts from its checkpoint (remap.py). It stays a block of
grid lines throughout, as height functions and the laser's columns need.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .case_folder import CaseFolder
from .grid import CORRIDOR_CELLS, CORRIDOR_SPOT_RADII, GAS_CELLS, Grid, plate_surface, uniform_lines
from .resolved_case import ResolvedCase

COARSENING = 1.25           # widths of cells outside the box grow by this, in whole base cells
TRAVEL_SPOT_RADII = 0.5     # how far the beam goes on one mesh
LIGHT_SPOT_RADII = 1.25     # fine cells around the beam's axis where nothing melts yet: 96 % of the light
MELT_CELLS = 6              # fine cells beyond the melt, and
GUARD_CELLS = 2             # how near melt may come to the coarse cells


@dataclass(frozen=True)
class Window:
    """The box of fine cells (`lower`, `upper`), and the boxes that melt and the beam's axis may not leave; each (3,) m."""

    lower: np.ndarray
    upper: np.ndarray
    melt_lower: np.ndarray
    melt_upper: np.ndarray
    axis_lower: np.ndarray
    axis_upper: np.ndarray

    def entries(self) -> dict[str, list[float]]:
        """For the solver's dictionary `mesh_window`."""
        return {name: getattr(self, name).tolist() for name in ("melt_lower", "melt_upper", "axis_lower", "axis_upper")}


def is_wanted(case: ResolvedCase) -> bool:
    """Whether the case's mesh follows its beam."""
    wanted = (case.data["numerics"].get("openfoam") or {}).get("mesh", "following") == "following"
    return wanted and all(name in case.physics for name in ("laser", "melting", "flow"))


def base_grid(case: ResolvedCase) -> Grid:
    """Cells of the spacing throughout the domain."""
    return Grid(*(uniform_lines(a, b, case.spacing) for a, b in zip(case.lower, case.upper)), False)


def beam_axis(case: ResolvedCase, time: float) -> tuple[np.ndarray, np.ndarray]:
    """Where the beam's axis is at `time` [s], (2,) m, and the direction of its travel, (2,) of length 1, or 0 for a beam at rest."""
    laser = case.data["laser"]
    start, end = (np.array(laser["path"][name][:2], dtype=float) for name in ("from", "to"))
    length = np.linalg.norm(end - start)
    if length == 0 or laser["speed"] <= 0:
        return start, np.zeros(2)
    travelled = np.clip(laser["speed"]*(time - laser["start"]), 0, length)
    return start + (end - start)*travelled/length, (end - start)/length


def place_window(case: ResolvedCase, top_of_bodies: float, time: float, melt: tuple[np.ndarray, np.ndarray] | None) -> Window:
    """The window for a mesh that starts at `time`; `melt`: lower and upper corner of what is molten then, None if nothing is."""
    spacing, radius = case.spacing, case.data["laser"]["spot_radius"]
    axis, direction = beam_axis(case, time)
    plate, travel = plate_surface(case), max(TRAVEL_SPOT_RADII*radius, 2*spacing)
    light = max(LIGHT_SPOT_RADII*radius, MELT_CELLS*spacing)
    lower = np.append(np.minimum(axis, axis + travel*direction) - light, plate - max(0.5*radius, MELT_CELLS*spacing))
    upper = np.append(np.maximum(axis, axis + travel*direction) + light, top_of_bodies + GAS_CELLS*spacing)
    if melt is not None:
        lower = np.minimum(lower, melt[0] - MELT_CELLS*spacing)
        upper = np.maximum(upper, melt[1] + MELT_CELLS*spacing)
    # a drop that flies off must not drag the fine cells through the whole domain
    reach = max(CORRIDOR_SPOT_RADII*radius, CORRIDOR_CELLS*spacing)
    ends = np.array([case.data["laser"]["path"][name][:2] for name in ("from", "to")], dtype=float)
    limit_lower = np.append(ends.min(axis=0) - reach, plate - reach)
    limit_upper = np.append(ends.max(axis=0) + reach, top_of_bodies + max(reach, GAS_CELLS*spacing))
    limit_lower, limit_upper = np.maximum(limit_lower, case.lower), np.minimum(limit_upper, case.upper)
    lower, upper = np.clip(lower, limit_lower, limit_upper), np.clip(upper, limit_lower, limit_upper)
    far = 1e3
    slack = np.append(1.001*travel*np.ones(2), far)
    middle = np.append(axis, 0.0)
    return Window(lower, upper, np.where(lower > limit_lower, lower + GUARD_CELLS*spacing, -far),
                  np.where(upper < limit_upper, upper - GUARD_CELLS*spacing, far), middle - slack, middle + slack)


def coarsened_lines(lines: np.ndarray, lower: float, upper: float) -> np.ndarray:
    """Those of equally spaced `lines` that a mesh takes which is fine from `lower` to `upper`."""
    step = lines[1] - lines[0]
    first = max(0, int(np.floor((lower - lines[0])/step + 1e-6)))
    last = min(len(lines) - 1, int(np.ceil((upper - lines[0])/step - 1e-6)))
    below = first - _steps(first)[::-1]
    above = last + _steps(len(lines) - 1 - last)
    return lines[np.concatenate([below, np.arange(first, last + 1), above])]


def _steps(count: int) -> np.ndarray:
    """Sums of whole widths 1, 2, 2, 2, 3, 4, ... that end at `count`; the last two share what is left."""
    sums, width = [0], 1.0
    while sums[-1] < count:
        width *= COARSENING
        sums.append(sums[-1] + round(width))
    if len(sums) > 2:
        sums[-2] = (sums[-3] + count + 1)//2
    sums[-1] = count
    return np.array(sorted(set(sums[1:] if count else [])), dtype=int)


def window_grid(base: Grid, window: Window) -> Grid:
    """The mesh of a window."""
    return Grid(*(coarsened_lines(lines, a, b) for lines, a, b in zip((base.x, base.y, base.z), window.lower, window.upper)), False)


def melt_box(case: ResolvedCase, written: CaseFolder, time: str) -> tuple[np.ndarray, np.ndarray] | None:
    """Lower and upper corner of the box around all cells that hold melt at a written time."""
    molten = (written.read(time, "fraction") >= 0.5) & (written.read(time, "T") >= case.primary["solidus"])
    if not molten.any():
        return None
    corners = []
    for lines, index in zip((written.grid.x, written.grid.y, written.grid.z), written.grid.cell_indices()):
        corners.append((lines[index[molten]].min(), lines[index[molten] + 1].max()))
    lower, upper = np.array(corners).T
    return lower, upper
