"""Volume fractions of the bodies on the grid: boxes exactly, spheres and waves by sub-sampling the cells that their surface cuts.

Each sample stands for a small cell of its own, in which the surface is taken as flat: a perturbation of a hundredth of the
radius, a tenth of a cell, is then there in full.

Later bodies lie over earlier ones: a body of the primary material fills, one of the surrounding material clears.
"""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from scipy.special import eval_legendre

from .errors import Refused
from .grid import Grid
from .resolved_case import ResolvedCase

CHUNK = 20000       # cut cells that are sampled at a time: 0.5 GB of sample points
SAMPLES = 10        # sub-samples along each edge of a cut cell: volume of a disc of 16 cells across to about 1e-5


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
        wave = abs((body.get("surface_wave") or {}).get("amplitude", 0.0))
        tops.append(max((_reach(body, sphere)[[2, 3]].sum() for sphere in spheres),
                        default=body.get("upper", case.upper)[2] + wave))
    return min(max(tops), case.upper[2])


def volume_fractions(case: ResolvedCase, grid: Grid) -> np.ndarray:
    """Share of the primary material in every cell, (n,) 0..1."""
    lines = (grid.x, grid.y, grid.z)
    bodies = [(body, body_spheres(body, case.is_planar)) for body in case.data["bodies"]]
    near = {id(spheres): [_cells_near(_reach(body, sphere), lines, grid) for sphere in spheres] for body, spheres in bodies}
    cut = np.zeros(grid.cell_count, dtype=bool)
    for cells in (cells for parts in near.values() for cells in parts):
        cut[cells] = True
    fraction = np.zeros(grid.cell_count)
    for body, _ in bodies:
        if body.get("surface_wave"):
            cut[_cells_at_wave(body, grid)] = True
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
    """Share of some cells (m,) that lies in the primary material; row_of: place of a cell among them, or -1."""
    samples = _sample_points(grid, cells)
    lines = (grid.x, grid.y, grid.z)
    widths = np.column_stack([np.diff(line)[index[cells]] for line, index in zip(lines, grid.cell_indices())])/SAMPLES
    inside = np.zeros(samples.shape[:2])
    for body, spheres in bodies:
        fills = body["material"] == case.primary_name
        if body["shape"] == "box":
            _lay_over(inside, slice(None), _box_samples(body, samples, widths, grid.planar), fills)
        for sphere, touched in zip(spheres, near[id(spheres)]):
            rows = row_of[touched]
            rows = rows[rows >= 0]
            if not rows.size:       # a sphere whose cells are all among others'
                continue
            _lay_over(inside, rows, _sphere_samples(body, sphere, samples[rows], widths[rows], grid.planar), fills)
    return inside.mean(axis=1)


def _lay_over(inside: np.ndarray, rows: np.ndarray | slice, share: np.ndarray, fills: bool) -> None:
    """A later body over what is there, sample by sample: its union with it where it fills, else what it leaves."""
    inside[rows] = np.maximum(inside[rows], share) if fills else np.minimum(inside[rows], 1 - share)


def _reach(body: dict, sphere: np.ndarray) -> np.ndarray:
    """The sphere that encloses a perturbed one."""
    perturbation = body.get("perturbation")
    return sphere*np.array([1, 1, 1, 1 + abs(perturbation["amplitude"])]) if perturbation else sphere


def surface_radius(body: dict, offset: np.ndarray, radius: float, planar: bool) -> np.ndarray:
    """Radius (...) m of a drop's surface in the directions of `offset` (..., 3) m, theta from the vertical:
    R (1 + a cos(n theta)) in the plane, R (1 + a P_n(cos theta)) in space."""
    perturbation = body.get("perturbation")
    if not perturbation:
        return np.full(offset.shape[:-1], radius)
    n, amplitude = perturbation["mode"], perturbation["amplitude"]
    theta = np.arctan2(np.hypot(offset[..., 0], offset[..., 1]), offset[..., 2])
    shape = np.cos(n*theta) if planar else eval_legendre(n, np.cos(theta))
    return radius*(1 + amplitude*shape)


def _sphere_samples(body: dict, sphere: np.ndarray, samples: np.ndarray, widths: np.ndarray, planar: bool) -> np.ndarray:
    """Share of every sample's own small cell inside a sphere or disc, (cells, samples): that of a plane with the surface's mean
    height over such a cell, h²/24 R below its top for each direction in which it bends."""
    offset = samples - sphere[:3]
    if planar:
        offset[..., 1] = 0
    distance = np.linalg.norm(offset, axis=-1)
    depth = surface_radius(body, offset, sphere[3], planar) - distance
    # a plane with normal n crosses a cell of edges w over the depth |n|.w
    crossings = np.abs(offset)*widths[:, None, :]/np.maximum(distance, 1e-300)[..., None]
    across = crossings.sum(axis=-1)
    share = np.where(depth > 0, 1.0, 0.0)
    cut = 2*np.abs(depth) < across + widths.max()*widths.max()/sphere[3]
    drop = (1 if planar else 2)*np.broadcast_to(np.square(widths[:, ::2]).mean(axis=1)[:, None], cut.shape)[cut]/(24*sphere[3])
    share[cut] = volume_below(crossings[cut]/across[cut][:, None], 0.5 + (depth[cut] - drop)/across[cut])
    return share


def volume_below(slopes: np.ndarray, distance: np.ndarray) -> np.ndarray:
    """Share (n,) of a unit cube with m.x < d, m = `slopes` (n, 3) >= 0 of sum 1, d = `distance` (n,).

    Six m_1 m_2 m_3 V = d^3 - sum over i of (d - m_i)^3 + sum over i < j of (d - m_i - m_j)^3 - (d - 1)^3, of each what is above
    0 (Scardovelli and Zaleski 2000, Journal of Computational Physics 164, 228); slopes below 1e-4 count as that.
    """
    m = np.maximum(slopes, 1e-4)
    m = m/m.sum(axis=1)[:, None]
    d = np.clip(distance, 0, 1)
    mirrored = d > 0.5                                            # the smaller part: its sum cancels less
    d = np.where(mirrored, 1 - d, d)
    cube = d**3 - (np.maximum(d[:, None] - m, 0)**3).sum(axis=1) + (np.maximum(d[:, None] - 1 + m, 0)**3).sum(axis=1)
    volume = np.clip(cube/(6*m.prod(axis=1)), 0, 1)
    return np.where(mirrored, 1 - volume, volume)


def _cells_at_wave(body: dict, grid: Grid) -> np.ndarray:
    """Labels of the cells that the wavy upper side of a box may cut."""
    amplitude, top = abs(body["surface_wave"]["amplitude"]), body["upper"][2]
    _, _, k = grid.cell_indices()
    return np.flatnonzero((grid.z[k] < top + amplitude) & (grid.z[k + 1] > top - amplitude))


def _box_samples(body: dict, samples: np.ndarray, widths: np.ndarray, planar: bool) -> np.ndarray:
    """Share of every sample's own small cell inside a box, (cells, samples), whose upper side may be wavy."""
    share = np.ones(samples.shape[:2])
    for axis in (0, 2) if planar else (0, 1, 2):
        upper = np.full(samples.shape[:2], body["upper"][axis])
        if axis == 2 and body.get("surface_wave"):
            wave = body["surface_wave"]
            upper = upper + wave["amplitude"]*np.cos(2*np.pi*samples[..., 0]/wave["wavelength"])
        half = 0.5*widths[:, axis, None]
        overlap = (np.minimum(samples[..., axis] + half, upper)
                   - np.maximum(samples[..., axis] - half, body["lower"][axis]))
        share = share*np.clip(overlap/(2*half), 0, 1)
    return share


def contains(body: dict, positions: np.ndarray, planar: bool) -> np.ndarray:
    """Which positions (n, 3) m lie inside a box or sphere, perturbation and wave included; none for a powder bed."""
    if body["shape"] == "sphere":
        offset = positions - np.array(body["center"], dtype=float)
        if planar:
            offset[:, 1] = 0
        return np.linalg.norm(offset, axis=-1) < surface_radius(body, offset, body["radius"], planar)
    if body["shape"] != "box":
        return np.zeros(len(positions), dtype=bool)
    upper = np.tile(np.array(body["upper"], dtype=float), (len(positions), 1))
    if body.get("surface_wave"):
        wave = body["surface_wave"]
        upper[:, 2] += wave["amplitude"]*np.cos(2*np.pi*positions[:, 0]/wave["wavelength"])
    within = (positions >= np.array(body["lower"], dtype=float)) & (positions < upper)
    return within[:, (0, 2) if planar else (0, 1, 2)].all(axis=1)


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
