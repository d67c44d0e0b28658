"""A grid as OpenFOAM's polyMesh, whole or one rank's block of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .foam_files import header
from .grid import Grid


def internal_faces(grid: Grid) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Internal faces (m, 4), owner (m,), neighbour (m,) in OpenFOAM's upper-triangular order."""
    nx, ny, nz = grid.shape
    i, j, k = grid.cell_indices()
    label = np.arange(grid.cell_count)
    corners = {0: ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)), 1: ((0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)),
               2: ((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))}
    faces, owners, neighbours = [], [], []             # axis by axis; then in OpenFOAM's order
    for axis, (inside, offset) in enumerate(((i < nx - 1, 1), (j < ny - 1, nx), (k < nz - 1, nx*ny))):
        faces.append(np.column_stack([grid.point_label(i + a, j + b, k + c)[inside] for a, b, c in corners[axis]]))
        owners.append(label[inside])
        neighbours.append(label[inside] + offset)
    owner, neighbour = np.concatenate(owners), np.concatenate(neighbours)
    order = np.lexsort((neighbour, owner))
    return np.concatenate(faces)[order], owner[order], neighbour[order]


def internal_order(grid: Grid) -> np.ndarray:
    """Where each internal face of OpenFOAM's order stands in a list axis by axis (x, y, z), each in the order of cells."""
    nx, ny, nz = grid.shape
    label = np.arange(grid.cell_count).reshape(nz, ny, nx)
    owner = np.concatenate([label[:, :, :-1].ravel(), label[:, :-1, :].ravel(), label[:-1].ravel()])
    neighbour = np.concatenate([label[:, :, 1:].ravel(), label[:, 1:, :].ravel(), label[1:].ravel()])
    return np.lexsort((neighbour, owner))


def _side_faces(grid: Grid, side: str, cells: np.ndarray) -> np.ndarray:
    """(faces, 4) point labels of a side, turned outward."""
    outward = {"x_min": ((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)), "x_max": ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)),
               "y_min": ((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)), "y_max": ((0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)),
               "z_min": ((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)), "z_max": ((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))}
    i, j, k = (index[cells] for index in grid.cell_indices())
    return np.column_stack([grid.point_label(i + a, j + b, k + c) for a, b, c in outward[side]])


def write_mesh(grid: Grid, patches: dict[str, str], folder: Path) -> None:
    """Write constant/polyMesh of an OpenFOAM case, or of one rank's part of it.

    patches: side (x_min ... z_max) to OpenFOAM's patch type, in the order in which they are to stand. A block has all of
    them, those that are not its own without faces, then one to each rank beside it.
    """
    mesh = folder/"constant"/"polyMesh"
    mesh.mkdir(parents=True, exist_ok=True)
    faces, owner, neighbour = internal_faces(grid)
    entries, start = [], len(faces)
    all_faces, all_owners = [faces], [owner]
    for side, kind in patches.items():
        cells = grid.patch_cells(side)
        side_faces = _side_faces(grid, side, cells)
        extra = ""
        if kind == "cyclic":
            extra = f" neighbourPatch {side[:2]}{'max' if side.endswith('min') else 'min'}; matchTolerance 1e-4;"
        entries.append(f"    {side} {{ type {kind}; nFaces {len(side_faces)}; startFace {start};{extra} }}\n")
        all_faces.append(side_faces)
        all_owners.append(cells)
        start += len(side_faces)
    for side, rank in getattr(grid, "neighbours", ()):
        # both blocks list these faces by rows along the side, from the same corner on: OpenFOAM's order for such a pair
        cells = grid.side_cells(side)
        entries.append(f"    {processor_patch(grid.rank, rank)} {{ type processor; nFaces {len(cells)}; startFace {start}; "
                       f"myProcNo {grid.rank}; neighbProcNo {rank}; }}\n")
        all_faces.append(_side_faces(grid, side, cells))
        all_owners.append(cells)
        start += len(cells)
    points, faces, owner = grid.points(), np.concatenate(all_faces), np.concatenate(all_owners)
    note = (f"nPoints:{len(points)} nCells:{grid.cell_count} nFaces:{len(faces)} nInternalFaces:{len(neighbour)}")
    _write_list(mesh/"points", header("vectorField", "points"), points, "(%.15g %.15g %.15g)")
    _write_list(mesh/"faces", header("faceList", "faces"), faces, "4(%d %d %d %d)")
    _write_list(mesh/"owner", header("labelList", "owner", note=note), owner[:, None], "%d")
    _write_list(mesh/"neighbour", header("labelList", "neighbour", note=note), neighbour[:, None], "%d")
    (mesh/"boundary").write_text(header("polyBoundaryMesh", "boundary") + f"{len(entries)}\n(\n" + "".join(entries) + ")\n")


def processor_patch(rank: int, other: int) -> str:
    """Name of the patch of `rank` toward `other`."""
    return f"procBoundary{rank}to{other}"


def _write_list(path: Path, head: str, rows: np.ndarray, form: str) -> None:
    body = "\n".join(form % tuple(row) for row in rows.tolist())
    path.write_text(f"{head}{len(rows)}\n(\n{body}\n)\n")
