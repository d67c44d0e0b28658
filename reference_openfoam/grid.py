"""The grid: a block of hexahedra on three sets of grid lines (mesh_files.py writes it as OpenFOAM's polyMesh).

Cells are of the case's spacing wherever things happen. In scenes with a laser they widen geometrically outside a corridor
around the beam's path; columns along z stay columns, which the laser source relies on. Cell (i, j, k) has the label
i + nx (j + ny k).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .resolved_case import ResolvedCase

WIDENING = 1.25                 # ratio of one cell to the next outside the corridor
CORRIDOR_SPOT_RADII = 2.0       # half width and depth of the corridor in spot radii: pools stay inside it
CORRIDOR_CELLS = 8              # and at least so many cells on each side of the path
GAS_CELLS = 4                   # fine cells above the highest grain


@dataclass(frozen=True)
class Grid:
    """Grid lines x (nx+1), y (ny+1), z (nz+1) in m; `planar`: one cell thick in y, fields do not vary along it."""

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    planar: bool

    @property
    def shape(self) -> tuple[int, int, int]:
        """Cells along x, y, z."""
        return len(self.x) - 1, len(self.y) - 1, len(self.z) - 1

    @property
    def cell_count(self) -> int:
        return int(np.prod(self.shape))

    def cell_volumes(self) -> np.ndarray:
        """(n,) m^3 in the order of cell labels."""
        dx, dy, dz = np.diff(self.x), np.diff(self.y), np.diff(self.z)
        return (dz[:, None, None]*dy[None, :, None]*dx[None, None, :]).ravel()

    def cell_centres(self) -> np.ndarray:
        """(n, 3) m in the order of cell labels."""
        cx, cy, cz = (0.5*(line[1:] + line[:-1]) for line in (self.x, self.y, self.z))
        z, y, x = np.meshgrid(cz, cy, cx, indexing="ij")
        return np.column_stack([x.ravel(), y.ravel(), z.ravel()])

    def points(self) -> np.ndarray:
        """Corners ((nx+1)(ny+1)(nz+1), 3) m, x fastest."""
        z, y, x = np.meshgrid(self.z, self.y, self.x, indexing="ij")
        return np.column_stack([x.ravel(), y.ravel(), z.ravel()])

    def point_label(self, i: np.ndarray, j: np.ndarray, k: np.ndarray) -> np.ndarray:
        return i + len(self.x)*(j + len(self.y)*k)

    def cell_indices(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """i, j, k of every cell (n,), in the order of cell labels."""
        nx, ny, nz = self.shape
        k, j, i = np.meshgrid(np.arange(nz), np.arange(ny), np.arange(nx), indexing="ij")
        return i.ravel(), j.ravel(), k.ravel()

    def cell_corners(self) -> np.ndarray:
        """(n, 8) point labels of each cell in VTK's hexahedron order."""
        i, j, k = self.cell_indices()
        offsets = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
        return np.column_stack([self.point_label(i + a, j + b, k + c) for a, b, c in offsets])

    def side_cells(self, side: str) -> np.ndarray:
        """Labels of the cells along a side of the block, in the order of that side's faces."""
        nx, ny, nz = self.shape
        labels = np.arange(self.cell_count).reshape(nz, ny, nx)
        axis = {"x": 2, "y": 1, "z": 0}[side[0]]
        return np.take(labels, 0 if side.endswith("min") else -1, axis=axis).ravel()

    def is_outer(self, side: str) -> bool:
        """Whether a side is one of the domain's (of a block of a divided grid some are not, see blocks.py)."""
        return True

    def patch_cells(self, side: str) -> np.ndarray:
        """Labels of the cells along a side of the domain; none if this side is not one."""
        return self.side_cells(side) if self.is_outer(side) else np.empty(0, dtype=int)

    def side_centres(self, side: str) -> np.ndarray:
        """(faces, 3) m: centres of the faces on a side of the domain."""
        centres = self.cell_centres()[self.patch_cells(side)]
        axis = "xyz".index(side[0])
        centres[:, axis] = (self.x, self.y, self.z)[axis][0 if side.endswith("min") else -1]
        return centres


def uniform_lines(lower: float, upper: float, spacing: float) -> np.ndarray:
    """Lines of equal cells as near to `spacing` as a whole number of them allows."""
    return np.linspace(lower, upper, max(1, round((upper - lower)/spacing)) + 1)


def widening_lines(lower: float, upper: float, fine_lower: float, fine_upper: float, spacing: float) -> np.ndarray:
    """Cells of `spacing` from fine_lower to fine_upper (both moved outward onto cells), widening beyond.

    The fine lines are those of the uniform grid; a widening part that would save fewer than two cells is left uniform.
    """
    lines = uniform_lines(lower, upper, spacing)
    step = lines[1] - lines[0]
    first = max(0, int(np.floor((fine_lower - lower)/step + 1e-6)))
    last = min(len(lines) - 1, int(np.ceil((fine_upper - lower)/step - 1e-6)))
    below = np.empty(0)
    if first:
        widths = _widths(lines[first] - lines[0], step, first)          # from the corridor outward
        below = (lines[first] - np.cumsum(widths))[::-1]
        below[0] = lines[0]
    above = np.empty(0)
    if last < len(lines) - 1:
        above = lines[last] + np.cumsum(_widths(lines[-1] - lines[last], step, len(lines) - 1 - last))
        above[-1] = lines[-1]
    return np.concatenate([below, lines[first:last + 1], above])


def _widths(length: float, step: float, uniform_cells: int) -> np.ndarray:
    """Cell widths that fill `length` outward from a cell of width `step`."""
    count = 1
    while step*WIDENING*(WIDENING**count - 1)/(WIDENING - 1) < length:
        count += 1
    if count > uniform_cells - 2:
        return np.full(uniform_cells, length/uniform_cells)
    widths = step*WIDENING**np.arange(1, count + 1)
    return widths*length/widths.sum()


def make_grid(case: ResolvedCase, top_of_bodies: float) -> Grid:
    """The grid of a case; `top_of_bodies` is the greatest z of any body [m]."""
    (x0, y0, z0), (x1, y1, z1) = case.lower, case.upper
    spacing = case.spacing
    if case.is_planar:
        return Grid(uniform_lines(x0, x1, spacing), np.array([-0.5, 0.5])*spacing, uniform_lines(z0, z1, spacing), True)
    if "laser" not in case.physics:
        return Grid(*(uniform_lines(a, b, spacing) for a, b in zip(case.lower, case.upper)), False)
    laser = case.data["laser"]
    (xa, ya), (xb, yb) = laser["path"]["from"], laser["path"]["to"]
    reach = max(CORRIDOR_SPOT_RADII*laser["spot_radius"], CORRIDOR_CELLS*spacing)
    plate = plate_surface(case)
    return Grid(widening_lines(x0, x1, min(xa, xb) - reach, max(xa, xb) + reach, spacing),
                widening_lines(y0, y1, min(ya, yb) - reach, max(ya, yb) + reach, spacing),
                widening_lines(z0, z1, plate - reach, top_of_bodies + GAS_CELLS*spacing, spacing), False)


def plate_surface(case: ResolvedCase) -> float:
    """Height of the highest box of the primary material [m]; the top of all bodies where there is none."""
    tops = [body["upper"][2] for body in case.data["bodies"]
            if body["shape"] == "box" and body["material"] == case.primary_name]
    return max(tops) if tops else case.upper[2]
