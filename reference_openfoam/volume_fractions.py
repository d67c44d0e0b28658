"""Volume fractions of the bodies on the grid: boxes exactly, spheres by sub-sampling the cells that their surface cuts.

Later bodies lie over earlier ones: a body of the primary material fills, one of the surrounding material clears.
"""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from .errors import Refused
from .grid import Grid
from .resolved_case import ResolvedCase

CHUNK = 20000       # cut cells that are sampled at a time: 0.5 GB of sample points
SAMPLES = 10        # sub-samples along each edge of a cut cell: volume of a sphere of 16 cells across to about 2e-5


def read_spheres(path: Path) -> np.ndarray:
    """Spheres of a bed file (columns x_m, y_m, z_m, radius_m): (n, 4) m.

    Errors: Refused with file and line.
    """
    with open(path, newline="", encoding="utf-8") as stream:
        rows = list(csv.reader(line for line in stream if not line.startswith("#")))
    if not rows or rows[0] != ["x_m", "y_m", "z_m", "radius_m"]:
        raise Refused(f"{path}:1: the header must be x_m,y_m,z_m,radius_m; make the bed again with ./cupel bed")
    spheres = []
    for number, row in enumerate(rows[1:], start=2):
        try:
            x, y, z, radius = map(float, row)
        except ValueError:
            raise Refused(f"{path}:{number}: must be four numbers; make the bed again with ./cupel bed") from None
        if not radius > 0:
            raise Refused(f"{path}:{number}: the radius is not above 0")
        spheres.append((x, y, z, radius))
    return np.array(spheres).reshape(-1, 4)


def body_spheres(body: dict, planar: bool) -> np.ndarray:
    """The spheres that a body consists of, (n, 4) m; none for a box. In the plane a sphere is a disc at y = 0."""
    if body["shape"] == "powder_bed":
        return read_spheres(Path(body["file"]))
    if body["shape"] == "sphere":
        x, y, z = body["center"]
        return np.array([[x, 0.0 if planar else y, z, body["radius"]]])
    return np.empty((0, 4))


def top_of_bodies(case: ResolvedCase) -> float:
    """Greatest z of any body of the primary material [m], not above the domain."""
    tops = []
    for body in case.data["bodies"]:
        if body["material"] != case.primary_name:
            continue
        spheres = body_spheres(body, case.is_planar)
        tops.append((spheres[:, 2] + spheres[:, 3]).max() if len(spheres) else body.get("upper", case.upper)[2])
    return min(max(tops), case.upper[2])


def volume_fractions(case: ResolvedCase, grid: Grid) -> np.ndarray:
    """Share of the primary material in every cell, (n,) 0..1."""
    lines = (grid.x, grid.y, grid.z)
    bodies = [(body, body_spheres(body, case.is_planar)) for body in case.data["bodies"]]
    near = {id(spheres): [_cells_near(sphere, lines, grid) for sphere in spheres] for _, spheres in bodies}
    cut = np.zeros(grid.cell_count, dtype=bool)
    for cells in (cells for parts in near.values() for cells in parts):
        cut[cells] = True
    fraction = np.zeros(grid.cell_count)
    for body, _ in bodies:
        if body["shape"] == "box":
            share = _box_share(body, grid)
            fraction = fraction + share*(1 - fraction) if body["material"] == case.primary_name else fraction*(1 - share)
    row_of = np.full(grid.cell_count, -1)
    for cells in np.array_split(np.flatnonzero(cut), max(1, np.count_nonzero(cut)//CHUNK)):
        row_of[cells] = np.arange(len(cells))
        fraction[cells] = _sampled(case, grid, bodies, near, cells, row_of)
        row_of[cells] = -1
    return fraction


def _sampled(case: ResolvedCase, grid: Grid, bodies: list, near: dict, cells: np.ndarray, row_of: np.ndarray) -> np.ndarray:
    """Share of the sample points of some cells (m,) that lie in the primary material; row_of: place of a cell among them, or -1."""
    samples = _sample_points(grid, cells)
    inside = np.zeros(samples.shape[:2], dtype=bool)
    axes = (0, 2) if grid.planar else (0, 1, 2)
    for body, spheres in bodies:
        fills = body["material"] == case.primary_name
        if body["shape"] == "box":
            within = np.all([(samples[..., a] >= body["lower"][a]) & (samples[..., a] < body["upper"][a]) for a in axes], axis=0)
            inside = inside | within if fills else inside & ~within
        for sphere, touched in zip(spheres, near[id(spheres)]):
            rows = row_of[touched]
            rows = rows[rows >= 0]
            distance = samples[rows] - sphere[:3]
            if grid.planar:
                distance[..., 1] = 0
            within = np.einsum("ijk,ijk->ij", distance, distance) <= sphere[3]**2
            inside[rows] = inside[rows] | within if fills else inside[rows] & ~within
    return inside.mean(axis=1)


def _cells_near(sphere: np.ndarray, lines: tuple[np.ndarray, ...], grid: Grid) -> np.ndarray:
    """Labels of the cells that the box around a sphere touches."""
    ranges = []
    for axis, line in enumerate(lines):
        if grid.planar and axis == 1:
            ranges.append(np.array([0]))
            continue
        first = np.searchsorted(line, sphere[axis] - sphere[3], side="right") - 1
        last = np.searchsorted(line, sphere[axis] + sphere[3], side="left")
        ranges.append(np.arange(max(first, 0), min(last, len(line) - 1)))
    nx, ny, _ = grid.shape
    return (ranges[0][None, None, :] + nx*(ranges[1][None, :, None] + ny*ranges[2][:, None, None])).ravel()


def _sample_points(grid: Grid, cells: np.ndarray) -> np.ndarray:
    """Sub-sample points of some cells: (cells, samples, 3) m."""
    positions = (np.arange(SAMPLES) + 0.5)/SAMPLES
    a, b, c = (part.ravel() for part in np.meshgrid(positions, np.array([0.5]) if grid.planar else positions, positions))
    corners, widths = [], []
    for line, index in zip((grid.x, grid.y, grid.z), grid.cell_indices()):
        corners.append(line[index[cells]])
        widths.append(np.diff(line)[index[cells]])
    return np.stack([corner[:, None] + width[:, None]*part[None, :]
                     for corner, width, part in zip(corners, widths, (a, b, c))], axis=-1)


def _box_share(body: dict, grid: Grid) -> np.ndarray:
    """Exact share of every cell inside a box."""
    shares = []
    for axis, line in enumerate((grid.x, grid.y, grid.z)):
        if grid.planar and axis == 1:
            shares.append(np.ones(1))
            continue
        overlap = np.minimum(line[1:], body["upper"][axis]) - np.maximum(line[:-1], body["lower"][axis])
        share = np.clip(overlap/np.diff(line), 0, 1)
        share[share < 1e-9] = 0
        share[share > 1 - 1e-9] = 1
        shares.append(share)
    return (shares[2][:, None, None]*shares[1][None, :, None]*shares[0][None, None, :]).ravel()
