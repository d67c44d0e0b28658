"""Fields from one mesh to the next, both made of whole cells of one base grid. What is conserved stays so, cell by cell:

    volume       ∫ α dV of each old cell; in one that is refined α follows the pattern of the bodies as they were at the start,
                 scaled to the cell's own mean (powder that the window reaches is as sharp as on a fine mesh), or is uniform if
                 that mean is no longer the pattern's
    enthalpy     ∫ H dV, H = α ρ₁ h₁ + (1 − α) ρ₂ c₂ T with h₁, T of the old cell; the solver inverts H on its first step
    momentum     ∫ ρ u dV
    flux         and its acceleration through every face of an old cell; inside one it runs linearly from face to face, so the new cells' divergence is
                 that of the old ones

The greatest temperature that was reached is averaged over the primary material, the pressure over the volume.
"""

from __future__ import annotations

import shutil

import numpy as np

from . import case_writer
from .case_folder import CaseFolder, mark_complete
from .face_fields import Fluxes, read_fluxes, write_fluxes
from .foam_files import scalar_list, vector_list, write_field_with
from .grid import Grid
from .resolved_case import ResolvedCase

STILL_THE_PATTERN = 0.05        # how far the mean of a coarse cell may be from that of its pattern to have it


class Overlap:
    """Old and new grid on a common base grid. Cell arrays have the shape (nz, ny, nx, ...) of their grid."""

    def __init__(self, base: Grid, old: Grid, new: Grid):
        self.base, self.old, self.new = base, old, new
        self._old, self._new = ([_indices(lines, taken) for lines, taken in zip(_lines(base), _lines(grid))] for grid in (old, new))
        self.base_volume = base.cell_volumes().reshape(base.shape[::-1])

    def spread(self, values: np.ndarray) -> np.ndarray:
        """Each old cell's value on all its base cells."""
        for axis, cuts in zip((2, 1, 0), self._old):
            values = np.repeat(values, np.diff(cuts), axis=axis)
        return values

    @staticmethod
    def _summed(values: np.ndarray, cuts_of: list[np.ndarray]) -> np.ndarray:
        for axis, cuts in zip((2, 1, 0), cuts_of):
            values = np.add.reduceat(values, cuts[:-1], axis=axis)
        return values

    def gather(self, values: np.ndarray) -> np.ndarray:
        """Sum over the base cells of each new cell."""
        return self._summed(values, self._new)

    def gather_old(self, values: np.ndarray) -> np.ndarray:
        """Sum over the base cells of each old cell."""
        return self._summed(values, self._old)


def _lines(grid: Grid) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return grid.x, grid.y, grid.z


def _indices(lines: np.ndarray, taken: np.ndarray) -> np.ndarray:
    """Where the taken lines stand among all."""
    return np.abs(lines[None, :] - taken[:, None]).argmin(axis=1)


def base_fraction(overlap: Overlap, fraction: np.ndarray, pattern: np.ndarray) -> np.ndarray:
    """α on base cells from α of old cells, each with its own mean exactly, in the pattern of the start where it still holds."""
    volume = overlap.gather_old(overlap.base_volume)
    mean = overlap.gather_old(overlap.base_volume*pattern)/volume
    holds = ((np.abs(fraction - mean) < STILL_THE_PATTERN) & (mean > 1e-9) & (mean < 1 - 1e-9) & (fraction >= 0) & (fraction <= 1))
    with np.errstate(divide="ignore", invalid="ignore"):
        # α = a + b pattern: emptied or filled up in proportion
        slope = np.where(holds, np.where(fraction <= mean, fraction/mean, (1 - fraction)/(1 - mean)), 0)
        offset = np.where(holds, np.where(fraction <= mean, 0, 1 - slope), fraction)
    return overlap.spread(offset) + overlap.spread(slope)*pattern


def remap_cells(overlap: Overlap, fields: dict[str, np.ndarray], pattern: np.ndarray, densities: tuple[float, float],
                surrounding_heat: float) -> dict[str, np.ndarray]:
    """Cell fields of the new mesh from those of the old: fraction, T, h (of the primary material), peak, U, p; adds H.

    densities: ρ₁, ρ₂; surrounding_heat: c₂.
    """
    primary, surrounding = densities
    alpha = base_fraction(overlap, fields["fraction"], pattern)
    volume = overlap.gather(overlap.base_volume)

    def mean(values: np.ndarray) -> np.ndarray:
        return overlap.gather(values*overlap.base_volume)/volume

    temperature, peak = overlap.spread(fields["T"]), overlap.spread(fields["peak_temperature"])
    share = np.clip(alpha, 0, 1)
    other = np.maximum(1 - alpha, 0)*surrounding*surrounding_heat*temperature       # as the solver counts α beyond 0 … 1
    result = {"fraction": mean(alpha), "T": mean(temperature), "p_rgh": mean(overlap.spread(fields["p_rgh"])),
              "volumetric_enthalpy": mean(np.maximum(alpha, 0)*primary*overlap.spread(fields["primary_enthalpy"]) + other)}
    shared = mean(share)
    result["peak_temperature"] = np.where(shared > 1e-6, mean(share*peak)/np.maximum(shared, 1e-6), mean(peak))
    density = share*primary + (1 - share)*surrounding
    mass = mean(density)
    velocity = fields["U"]
    result["U"] = np.stack([mean(density*overlap.spread(velocity[..., part]))/mass for part in range(3)], axis=-1)
    return result


def remap_fluxes(old: Grid, new: Grid, fluxes: Fluxes) -> Fluxes:
    """Face fluxes of the new mesh."""
    result = []
    for axis, flux in enumerate(fluxes):
        for other, (before, after) in enumerate(zip(_lines(old), _lines(new))):
            matrix = _between_faces(before, after) if other == axis else _shares(before, after)
            flux = np.moveaxis(np.tensordot(matrix, flux, axes=(1, 2 - other)), 0, 2 - other)
        result.append(flux)
    return tuple(result)


def _between_faces(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """(new lines, old lines): weights of linear interpolation."""
    return np.column_stack([np.interp(after, before, unit) for unit in np.eye(len(before))])


def _shares(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """(new cells, old cells): which part of each old cell lies in each new one."""
    overlap = np.minimum(after[1:, None], before[None, 1:]) - np.maximum(after[:-1, None], before[None, :-1])
    return np.maximum(overlap, 0)/np.diff(before)[None, :]


def remap(case: ResolvedCase, base: Grid, pattern: np.ndarray, written: CaseFolder, time: str, target: CaseFolder) -> None:
    """Write time `time` of `written` into the folders of `target`, whose frame is there, and mark it complete."""
    old, new = written.grid, target.grid
    names = ("fraction", "T", "primary_enthalpy", "peak_temperature", "U", "p_rgh")
    shaped = {}
    for name in names:
        values = written.read(time, name)
        shaped[name] = values.reshape(old.shape[::-1] + values.shape[1:])
    cells = remap_cells(Overlap(base, old, new), shaped, pattern.reshape(base.shape[::-1]),
                        (case.primary["density"], case.surrounding["density"]), case.surrounding["specific_heat"])
    fluxes = {name: remap_fluxes(old, new, read_fluxes(written, time, name)) for name in ("phi", "acceleration")
              if (written.parts()[0][0]/time/name).is_file()}
    boundaries = case_writer.boundary_sections(case, target.path/"boundary_sections")
    boundaries["peak_temperature"] = boundaries["T"]
    boundaries["volumetric_enthalpy"] = case_writer.calculated_boundaries(case)
    (first, _), *_ = written.parts()
    for part, block in target.parts():
        folder = part/time
        for name, values in cells.items():
            own = target.part(values.reshape((-1,) + values.shape[3:]), block)
            vector = own.ndim == 2
            write_field_with(folder/name, "volVectorField" if vector else "volScalarField", DIMENSIONS[name],
                             (vector_list if vector else scalar_list)(own), boundaries[name])
        for name, values in fluxes.items():
            write_fluxes(folder/name, block, case_writer.patch_types(case), values, new, DIMENSIONS[name])
        shutil.copytree(first/time/"uniform", folder/"uniform")
        mark_complete(folder)


DIMENSIONS = {"fraction": "[0 0 0 0 0 0 0]", "T": "[0 0 0 1 0 0 0]", "peak_temperature": "[0 0 0 1 0 0 0]", "U": "[0 1 -1 0 0 0 0]",
              "p_rgh": "[1 -1 -2 0 0 0 0]", "volumetric_enthalpy": "[1 -1 -2 0 0 0 0]",
              "phi": "[0 3 -1 0 0 0 0]", "acceleration": "[0 3 -2 0 0 0 0]"}
