"""Face fluxes of a block of grid lines: three arrays in place of OpenFOAM's lists of internal faces and patches.

    fluxes along x, y, z through all faces normal to that axis: (nz, ny, nx+1), (nz, ny+1, nx), (nz+1, ny, nx), positive with the axis
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from .blocks import Block
from .case_folder import CaseFolder
from .errors import Refused
from .foam_files import header, read_field, scalar_list
from .grid import Grid
from .mesh_files import internal_order, processor_patch
from .resolved_case import SIDES

Fluxes = tuple[np.ndarray, np.ndarray, np.ndarray]
_AXIS = {"x": 2, "y": 1, "z": 0}        # of the arrays


def empty_fluxes(grid: Grid) -> Fluxes:
    """Arrays for all faces of a grid."""
    nx, ny, nz = grid.shape
    return np.zeros((nz, ny, nx + 1)), np.zeros((nz, ny + 1, nx)), np.zeros((nz + 1, ny, nx))


def _inner(fluxes: Fluxes) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Views of the faces between cells."""
    return fluxes[0][:, :, 1:-1], fluxes[1][:, 1:-1, :], fluxes[2][1:-1]


def _side(fluxes: Fluxes, side: str) -> tuple[np.ndarray, float]:
    """View of the faces along a side, and the sign of outward."""
    axis = "xyz".index(side[0])
    at = [slice(None)]*3
    at[_AXIS[side[0]]] = 0 if side.endswith("min") else -1
    return fluxes[axis][tuple(at)], -1.0 if side.endswith("min") else 1.0


def _patches(grid: Grid) -> list[tuple[str, str]]:
    """Patch and side, of all patches that have faces."""
    own = [(side, side) for side in SIDES if grid.is_outer(side)]
    return own + [(processor_patch(grid.rank, rank), side) for side, rank in (grid.neighbours if isinstance(grid, Block) else ())]


def read_fluxes(written: CaseFolder, time: str, name: str) -> Fluxes:
    """Fluxes of a written time on the whole grid.

    Errors: Refused if a file is cut short.
    """
    whole = empty_fluxes(written.grid)
    for folder, block in written.parts():
        own = empty_fluxes(block)
        path = folder/time/name
        inner = _inner(own)
        values = np.empty(sum(view.size for view in inner))
        values[internal_order(block)] = read_field(path, len(values))
        for view, part in zip(inner, np.split(values, np.cumsum([view.size for view in inner])[:-1])):
            view[...] = part.reshape(view.shape)
        raw = path.read_bytes()
        for patch, side in _patches(block):
            view, sign = _side(own, side)
            view[...] = sign*_patch_values(raw, path, patch, view.size).reshape(view.shape)
        for axis in range(3):
            place = list(block.place) if isinstance(block, Block) else 3*[slice(None)]
            if isinstance(block, Block):
                along = 2 - axis
                place[along] = slice(place[along].start, place[along].stop + 1)
            whole[axis][tuple(place)] = own[axis]
    return whole


def _patch_values(raw: bytes, path: Path, patch: str, count: int) -> np.ndarray:
    """Values (count,) of a patch of a binary face field."""
    start = re.compile(rb"\n\s*" + patch.encode() + rb"\s*\{").search(raw, raw.find(b"internalField"))
    found = start and re.compile(rb"value\s+(?:uniform\s+([^;]+);|nonuniform\s+List<scalar>\s*(\d+)\s*\()").search(raw, start.end())
    if not found:
        raise Refused(f"{path}: has no values on {patch}")
    if found.group(1):
        return np.full(count, float(found.group(1)))
    if int(found.group(2)) != count or len(raw) < found.end() + 8*count:
        raise Refused(f"{path}: does not hold {count} values on {patch}")
    return np.frombuffer(raw, dtype="<f8", count=count, offset=found.end())


def write_fluxes(path: Path, grid: Grid, patches: dict[str, str], fluxes: Fluxes, whole: Grid,
                 dimensions: str = "[0 3 -1 0 0 0 0]") -> None:
    """Write the part of `fluxes` (on the `whole` grid) that `grid` has; patches: side to OpenFOAM's patch type."""
    own = fluxes
    if isinstance(grid, Block):
        (z, y, x) = grid.place
        own = (fluxes[0][z, y, x.start:x.stop + 1], fluxes[1][z, y.start:y.stop + 1, x], fluxes[2][z.start:z.stop + 1, y, x])
    internal = np.concatenate([view.ravel() for view in _inner(own)])[internal_order(grid)]
    names = dict(_patches(grid))
    text = ""
    for patch in [*patches, *(name for name in names if name not in patches)]:
        if patch in names:
            view, sign = _side(own, names[patch])
            values = scalar_list(sign*view.ravel())
        else:
            values = "nonuniform List<scalar> 0()"
        kind = {"wall": "calculated", "patch": "calculated"}.get(patches.get(patch, "processor"), patches.get(patch, "processor"))
        text += f"    {patch} {{ type {kind}; value {values}; }}\n"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(header("surfaceScalarField", path.name) + f"dimensions {dimensions};\n\ninternalField {scalar_list(internal)};\n\n"
                    f"boundaryField\n{{\n{text}}}\n")
